// Intruders: vertices of one component of the isosurface that the mesh of another has swallowed.
//
// Where a speck lies close to a large sheet, the triangulation of their samples may give some of the speck's vertices
// to the sheet; the speck itself comes from another mesh then, and the two cross.
#pragma once

#include <cstdint>

#include "raycast/isosurface.h"
#include "surface/surface_mesh.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Takes the inner vertices out of each piece of the mesh that lie on another component than most of its vertices do,
// and fills their links by the triangulations of the least area that have no edge the mesh has elsewhere; where there
// is none the vertex stays. A disk replaces a disk, so the mesh stays homeomorphic to what it was. Returns how many
// went.
std::int64_t remove_intruders(SurfaceMesh& mesh, const ScalarGrid& grid, const Isosurface& isosurface,
                              const IsosurfaceTopology& topology);

}  // namespace deliso
