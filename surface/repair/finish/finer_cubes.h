// Components from marching cubes on a finer grid: meshes that lie as near to the isosurface as is asked for.
#pragma once

#include <cstdint>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Appends the mesh of one component to `mesh`. The interpolant within a part of a voxel cell is trilinear again, so
// samples of it on a grid that is finer by whole factors have the same isosurface. Marching cubes has the exact
// topology there, vertices on the surface, and triangles within the diagonal of a finer cell of it: less than
// `max_distance`. Returns false, and appends nothing, where the finer grid would be too large, or where the rounding of
// its samples gives another topology. The mesh has neighbours, and pole heights of one voxel.
bool append_finer_cubes(std::uint32_t component, const ExactSurface& surface, double max_distance, SurfaceMesh& mesh);

}  // namespace deliso
