// The last resort of repair: components taken from marching cubes, whose topology is exact.
#pragma once

#include <vector>

#include "raycast/isosurface.h"
#include "surface/surface_mesh.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The marching-cubes mesh, in mesh space, of the components that `done` leaves out. Pole heights are one voxel.
SurfaceMesh polygonized_components(const ScalarGrid& grid, const Isosurface& isosurface,
                                   const IsosurfaceTopology& topology, const std::vector<bool>& done);

}  // namespace deliso
