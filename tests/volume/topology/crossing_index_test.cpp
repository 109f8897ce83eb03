// Which crossings a cell has, against all crossings of the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

TEST(CrossingIndex, VisitsEveryCrossingOfACellOnce) {
  const Dims dims{7, 5, 6};
  Rng rng(11);
  std::vector<double> samples(static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1] * dims[2]));
  for (double& sample : samples) sample = rng.uniform(-1, 1);
  const ScalarGrid grid(dims, samples);
  const IsosurfaceTopology topology = exact_topology(grid, 0);
  std::size_t visited = 0;
  for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
        const CellIndex cell{i, j, k};
        // A crossing is on an edge of the cell when it lies in the closed cell.
        std::vector<std::uint32_t> expected;
        for (std::uint32_t c = 0; c < topology.crossings.size(); ++c) {
          const EdgeCrossing& crossing = topology.crossings[c];
          bool is_here = true;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3 at = crossing_position(grid, crossing);
            is_here &= cell[axis] <= at[axis] && at[axis] <= cell[axis] + 1;
          }
          if (is_here) expected.push_back(c);
        }
        std::vector<std::uint32_t> found;
        topology.index.for_each_crossing_of_cell(cell, [&](std::uint32_t c) { found.push_back(c); });
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << i << ' ' << j << ' ' << k;
        visited += found.size();
      }
    }
  }
  EXPECT_GT(visited, topology.crossings.size());
}

}  // namespace
}  // namespace deliso
