// Foreign vertices: vertices of one exact component in the mesh of another.
//
// If a small component lies close to a large sheet, the triangulation of their samples may connect some vertices of the
// small component to the sheet. The small component is then taken from another mesh, and the two may cross.
#pragma once

#include <cstdint>
#include <span>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

struct ForeignVertices {
  std::int64_t removed = 0;
  std::int64_t left = 0;  // vertices that had to stay
};

// From each piece of the mesh, removes the inner vertices that lie on another component than most of its vertices.
// Their links are filled by triangulations of least area whose edges are not in the mesh elsewhere. A vertex stays if
// there is no such triangulation, or if no piece of its own component is near: then it may be the only vertex on a part
// of that component. A disk replaces a disk, so the mesh stays homeomorphic to what it was. `component_of` is the exact
// component of each vertex, or kNoComponent (mesh_pieces.h).
ForeignVertices remove_foreign_vertices(SurfaceMesh& mesh, std::span<const std::uint32_t> component_of);

}  // namespace deliso
