// Points of an isosurface that favour no mesher: they lie inside voxel cells, away from the grid edges that hold the
// vertices of marching cubes.
#pragma once

#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Where the isosurface meets the lines through the middles of voxel cells along x, y and z, in world coordinates: there
// the interpolant is linear between opposite faces, so the points are exact but for rounding.
std::vector<Vec3> isosurface_samples(const ScalarGrid& grid, double isovalue);

}  // namespace deliso
