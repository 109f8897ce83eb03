// Points of an isosurface that favour no mesher: they lie inside voxel cells, away from the grid edges, on which the
// vertices of marching cubes lie.
#pragma once

#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The points where the isosurface meets the lines through the middles of voxel cells along x, y and z, in world
// coordinates. The interpolant is linear along such a line within a cell, so the points are exact but for rounding.
std::vector<Vec3> isosurface_samples(const ScalarGrid& grid, double isovalue);

}  // namespace deliso
