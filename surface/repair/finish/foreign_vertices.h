// Intruders: vertices of one component of the isosurface that the mesh of another has swallowed.
//
// Where a speck lies close to a large sheet, the triangulation of their samples may give some of the speck's vertices
// to the sheet; the speck itself comes from another mesh then, and the two may cross.
#pragma once

#include <cstdint>
#include <span>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

struct ForeignVertices {
  std::int64_t removed = 0;
  std::int64_t left = 0;  // that had to stay
};

// Takes the inner vertices out of each piece of the mesh that lie on another component than most of its vertices do,
// and fills their links by the triangulations of the least area that have no edge the mesh has elsewhere. A vertex
// stays where there is none, and where no piece of its own component is near: it may stand for a part of that. A disk
// replaces a disk, so the mesh stays homeomorphic to what it was. `component_of`: the exact component of each vertex,
// or kNoComponent (mesh_pieces.h).
ForeignVertices remove_foreign_vertices(SurfaceMesh& mesh, std::span<const std::uint32_t> component_of);

}  // namespace deliso
