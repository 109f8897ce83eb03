// Points of the isosurface within voxel cells, where distances below 0.75 voxel are judged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// Where the isosurface crosses the edges of a grid so many times as fine, but for those of the grid itself; in samples.
// Components that are to be left out (empty: none is) have none.
std::vector<Vec3> inner_crossings(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                                  std::span<const std::uint8_t> is_dropped, int times);

}  // namespace deliso
