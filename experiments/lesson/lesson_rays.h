// Searches of the program, replayed slowly: the nodes of the kd-tree, the voxel cells, the cubic in each (Dey and
// Levine, sections 4.1 and 4.2, Figures 12 and 13).
#pragma once

#include <cstdint>

#include "experiments/config/json.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A few lines through the volume, drawn by the seed, with many hits first. Each: origin and direction in mesh space,
// `nodes` in the order of the traversal, `cells` that can hold the isovalue with the cubic in Bernstein form and its
// roots, and `hits`: those of Isosurface::all_hits(), bit for bit, after as many cubics, or InternalError is thrown.
// Precondition: no sample equals `isovalue`.
Json lesson_rays(const ScalarGrid& grid, double isovalue, const Vec3& spacing, std::uint64_t seed);

}  // namespace deliso
