// The numbers of the crossings of cells gone through row by row, against those that the index looks up one by one.
#include "volume/topology/cell_crossings.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {
namespace {

ScalarGrid random_grid(const Dims& dims, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> samples(static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1] * dims[2]));
  // Rows without a crossing, too.
  for (double& sample : samples) sample = rng.uniform(-1, 1) < 0.8 ? 1 : -1;
  return {dims, samples};
}

void expect_those_of_the_index(const CrossingIndex& index, const CellIndex& cell, std::uint8_t pattern,
                               const CellCrossings& crossings) {
  for (int edge = 0; edge < kCellEdges; ++edge) {
    if ((crossed_edges(pattern) >> edge & 1) == 0) continue;
    ASSERT_EQ(crossings.number(edge), index.number(cell, edge)) << cell[0] << ' ' << cell[1] << ' ' << cell[2];
  }
}

TEST(CellCrossings, HaveTheNumbersOfTheIndex) {
  for (const Dims& dims : {Dims{7, 5, 6}, Dims{64, 4, 5}, Dims{65, 6, 4}, Dims{131, 5, 5}, Dims{2, 2, 2}}) {
    const ScalarGrid grid = random_grid(dims, 5);
    const CrossingIndex index(grid, 0);
    CellCrossings crossings(index);
    index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) {
      crossings.move_to(cell);
      expect_those_of_the_index(index, cell, pattern, crossings);
    });
  }
}

TEST(CellCrossings, GoToCellsInAnyOrder) {
  const ScalarGrid grid = random_grid({67, 7, 8}, 6);
  const CrossingIndex index(grid, 0);
  std::vector<std::pair<CellIndex, std::uint8_t>> cells;
  index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) { cells.emplace_back(cell, pattern); });
  CellCrossings crossings(index);
  Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    const auto& [cell, pattern] = cells[rng.below(cells.size())];
    crossings.move_to(cell);
    expect_those_of_the_index(index, cell, pattern, crossings);
  }
}

}  // namespace
}  // namespace deliso
