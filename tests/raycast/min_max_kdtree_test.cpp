#include "raycast/min_max_kdtree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raycast/active_cells.h"
#include "tests/support/raycast_fields.h"

namespace deliso {
namespace {

using testing::noise_grid;

// Smallest and largest sample of the cells from low to high (cells of the grid, inclusive), sample by sample.
std::pair<double, double> range_of(const ScalarGrid& grid, const Cell& low, const Cell& high) {
  double smallest = grid.at(low[0], low[1], low[2]);
  double largest = smallest;
  for (std::int32_t k = low[2]; k <= high[2] + 1; ++k)
    for (std::int32_t j = low[1]; j <= high[1] + 1; ++j)
      for (std::int32_t i = low[0]; i <= high[0] + 1; ++i) {
        smallest = std::min(smallest, grid.at(i, j, k));
        largest = std::max(largest, grid.at(i, j, k));
      }
  return {smallest, largest};
}

std::vector<Dims> some_dims() { return {{2, 2, 2}, {3, 2, 2}, {2, 9, 3}, {10, 7, 6}, {5, 17, 9}, {2, 2, 40}}; }

// A block of extended cells in cells of the grid.
CellBlock inner(const CellBlock& block, const Dims& dims) {
  return {grid_cell(block.low, dims), grid_cell(block.high, dims)};
}

TEST(MinMaxKdTree, EveryNodeHasTheRangeOfItsSamples) {
  Rng rng(31);
  for (const Dims& dims : some_dims())
    for (const std::int32_t leaf_cells : {1, 2, 7, 8, 100000}) {
      const ScalarGrid grid = noise_grid(dims, {1, 1, 1}, rng);
      const MinMaxKdTree tree(grid, leaf_cells);
      for (int level = std::max(tree.leaf_level(), 1); level <= tree.root_level(); ++level)
        for (std::int32_t k = 0; k < dims[2] - 1; ++k)
          for (std::int32_t j = 0; j < dims[1] - 1; ++j)
            for (std::int32_t i = 0; i < dims[0] - 1; ++i) {
              const CellBlock block = inner(tree.block(level, {i, j, k}), dims);
              ASSERT_EQ(tree.range(level, {i, j, k}), range_of(grid, block.low, block.high));
              ASSERT_TRUE(block.low[0] <= i && i <= block.high[0] && block.low[1] <= j && j <= block.high[1] &&
                          block.low[2] <= k && k <= block.high[2]);
            }
    }
}

TEST(MinMaxKdTree, LevelsAreNestedHalvesOfTheLongestSide) {
  Rng rng(32);
  for (const Dims& dims : some_dims()) {
    const ScalarGrid grid = noise_grid(dims, {1, 1, 1}, rng);
    const MinMaxKdTree tree(grid, 1);
    const CellBlock root = inner(tree.block(tree.root_level(), {0, 0, 0}), dims);
    for (std::size_t a = 0; a < 3; ++a) {
      ASSERT_EQ(root.low[a], 0);
      ASSERT_EQ(root.high[a], dims[a] - 2);
    }
    for (int level = 1; level <= tree.root_level(); ++level)
      for (std::int32_t i = 0; i < dims[0] - 1; ++i) {
        const Cell cell{i, (dims[1] - 2) / 2, dims[2] - 2};
        const CellBlock parent = tree.block(level, cell);
        const CellBlock child = tree.block(level - 1, cell);
        int narrower = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          ASSERT_GE(child.low[a], parent.low[a]);
          ASSERT_LE(child.high[a], parent.high[a]);
          narrower += static_cast<int>(child.low[a] != parent.low[a] || child.high[a] != parent.high[a]);
        }
        ASSERT_LE(narrower, 1);
      }
  }
}

TEST(MinMaxKdTree, CommonLevelIsThatOfTheSmallestNodeHoldingBothCells) {
  Rng rng(33);
  for (const Dims& dims : some_dims()) {
    const ScalarGrid grid = noise_grid(dims, {1, 1, 1}, rng);
    const MinMaxKdTree tree(grid, 1);
    const auto random_cell = [&] {
      Cell cell;
      for (std::size_t a = 0; a < 3; ++a)
        cell[a] = static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(dims[a] - 1)));
      return cell;
    };
    for (int trial = 0; trial < 500; ++trial) {
      const Cell p = random_cell();
      const Cell q = random_cell();
      int expected = 0;
      const auto same = [](const CellBlock& x, const CellBlock& y) { return x.low == y.low && x.high == y.high; };
      while (!same(tree.block(expected, p), tree.block(expected, q))) ++expected;
      ASSERT_EQ(tree.common_level(p, q), expected) << "trial " << trial;
    }
  }
}

TEST(MinMaxKdTree, TakesTwoSamplesPerCellAtMost) {
  Rng rng(34);
  const ScalarGrid grid = noise_grid({64, 65, 66}, {1, 1, 1}, rng);
  EXPECT_LE(MinMaxKdTree(grid, 1).bytes(), 9 * grid.sample_count() / 4);
  EXPECT_LE(MinMaxKdTree(grid, 64).bytes(), grid.sample_count() / 14);
}

TEST(ActiveCells, AreThoseWithSamplesOnBothSides) {
  Rng rng(35);
  std::vector<Dims> list = some_dims();
  list.push_back({63, 3, 2});
  list.push_back({64, 3, 2});
  list.push_back({65, 2, 3});
  for (const Dims& dims : list)
    for (const double isovalue : {-1.0, 5.5, 127.5, 250.1, 300.0}) {
      const ScalarGrid grid = noise_grid(dims, {1, 1, 1}, rng);
      const ActiveCells active(grid, isovalue);
      std::size_t count = 0;
      for (std::int32_t z = 0; z <= dims[2]; ++z)
        for (std::int32_t y = 0; y <= dims[1]; ++y)
          for (std::int32_t x = 0; x <= dims[0]; ++x) {
            // The samples of the extended cell, those beyond the grid taken from its nearest face.
            int above = 0;
            for (int corner = 0; corner < 8; ++corner) {
              const std::int32_t i = std::clamp(x - 1 + (corner & 1), 0, dims[0] - 1);
              const std::int32_t j = std::clamp(y - 1 + ((corner >> 1) & 1), 0, dims[1] - 1);
              const std::int32_t k = std::clamp(z - 1 + (corner >> 2), 0, dims[2] - 1);
              above += static_cast<int>(grid.at(i, j, k) > isovalue);
            }
            const bool expected = above != 0 && above != 8;
            count += static_cast<std::size_t>(expected);
            ASSERT_EQ(active.is_active({x, y, z}), expected) << x << " " << y << " " << z;
          }
      ASSERT_EQ(active.count(), count);
    }
}

}  // namespace
}  // namespace deliso
