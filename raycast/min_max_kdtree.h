// A kd-tree over the voxel cells of a grid, with the smallest and largest sample of every node.
//
// A node covers a box of cells. The root covers all cells. Every level halves the boxes of the level above along one
// axis, the one with the longest side, at the multiple of a power of two nearest the middle. So all boxes of a level
// have the same size (cut off at the volume's far faces), a level is a small regular grid of nodes, and the tree needs
// no pointers. The node of a level that holds a cell is found by a shift of the cell's coordinates. The smallest node
// that holds two cells follows from the highest bit in which they differ. The tree stores two samples per cell and is
// built bottom-up by pairwise minima and maxima.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "raycast/cell_walk.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Bits needed to write a number that is not negative.
inline int bit_width(std::int32_t value) { return 32 - std::countl_zero(static_cast<std::uint32_t>(value)); }

class MinMaxKdTree {
 public:
  // Leaves hold at most `leaf_cells` cells (the largest power of two that is not above it). Precondition: >= 1.
  MinMaxKdTree(const ScalarGrid& grid, std::int32_t leaf_cells);

  // Levels are counted from the cells up: a node of level l covers up to 2^l cells. Levels below leaf_level() are not
  // stored, nor is level 0, whose ranges follow from a cell's own samples.
  [[nodiscard]] int leaf_level() const { return leaf_level_; }
  [[nodiscard]] int root_level() const { return static_cast<int>(levels_.size()) - 1; }
  // The level of the smallest node that holds both cells of the grid; 0 if they are the same cell.
  [[nodiscard]] int common_level(const Cell& a, const Cell& b) const;
  // Smallest and largest sample of the node that holds `cell` (a cell of the grid). Precondition: the level is stored.
  [[nodiscard]] std::pair<double, double> range(int level, const Cell& cell) const;
  [[nodiscard]] bool holds(double isovalue, int level, const Cell& cell) const {
    const auto [low, high] = range(level, cell);
    return low < isovalue && isovalue < high;
  }
  // The box of that node in extended cells; a node at the volume's faces extends outward without end.
  [[nodiscard]] CellBlock block(int level, const Cell& cell) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  // One level: how often each axis has been halved, counted from the cells, and where its nodes are stored.
  struct Level {
    std::array<int, 3> shift{};
    std::array<std::size_t, 3> dims{};
    std::size_t first = 0;  // index of its first node; all nodes of a level in x-fastest order
  };
  [[nodiscard]] static std::size_t node(const Level& level, const Cell& cell) {
    const auto at = [&](std::size_t a) { return static_cast<std::size_t>(cell[a]) >> level.shift[a]; };
    return level.first + at(0) + level.dims[0] * (at(1) + level.dims[1] * at(2));
  }
  void lay_out(std::int32_t leaf_cells);

  Cell cells_{};  // cells per axis
  Dims dims_{};   // samples per axis
  int leaf_level_ = 0;
  std::vector<Level> levels_;
  // The level whose nodes first join cells that differ in this bit.
  std::array<std::array<std::int8_t, 32>, 3> level_of_bit_{};
  Samples low_;   // smallest sample of every node
  Samples high_;  // largest sample of every node
};

// ---- Inline: one test per node of a search --------------------------------------------------------------------------

inline int MinMaxKdTree::common_level(const Cell& a, const Cell& b) const {
  int level = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t differing = a[axis] ^ b[axis];
    if (differing == 0) continue;
    const auto highest = static_cast<std::size_t>(bit_width(differing) - 1);
    level = std::max(level, static_cast<int>(level_of_bit_[axis][highest]));
  }
  return level;
}

inline std::pair<double, double> MinMaxKdTree::range(int level, const Cell& cell) const {
  const std::size_t i = node(levels_[static_cast<std::size_t>(level)], cell);
  return visit_samples(low_, [&]<class Sample>(const SampleArray<Sample>& low) {
    const auto& high = *std::get_if<SampleArray<Sample>>(&high_);
    return std::pair(static_cast<double>(low[i]), static_cast<double>(high[i]));
  });
}

}  // namespace deliso
