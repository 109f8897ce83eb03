// How far the isosurface is, in bricks of 4 x 4 x 4 extended cells: one signed byte per brick, small enough for the
// caches.
//
// Most points and segments that a mesher asks about lie far from the surface. For these one read of this table gives
// the side on which the point lies, or shows that the segment has no hit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "raycast/active_cells.h"
#include "raycast/cell_walk.h"
#include "volume/scalar_grid.h"

namespace deliso {

class EmptyBricks {
 public:
  static constexpr int kFarthest = 12;  // bricks; greater distances count as this one

  // `active` has been made for this grid and isovalue. The same for any number of threads.
  EmptyBricks(const ScalarGrid& grid, const ActiveCells& active, double isovalue, int threads = 1);

  // 0 when the cell's brick has an active cell. Otherwise plus or minus d >= 1: all bricks up to d - 1 away from it in
  // every direction have none, and the field in them is above (plus) or below the isovalue.
  [[nodiscard]] int clearance(const Cell& cell) const {
    return clearance_[index(static_cast<std::size_t>(cell[0]) >> kShift, static_cast<std::size_t>(cell[1]) >> kShift,
                            static_cast<std::size_t>(cell[2]) >> kShift)];
  }

  // Whether the box of bricks that two cells with these clearances span is known to be empty.
  static bool is_empty_between(const Cell& a, int clearance_a, const Cell& b, int clearance_b) {
    int apart = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      apart = std::max(apart, std::abs((a[axis] >> kShift) - (b[axis] >> kShift)));
    return apart < std::max(std::abs(clearance_a), std::abs(clearance_b));
  }
  // A block of cells around a cell with this clearance (not 0), none of which holds the isovalue. It may reach beyond
  // the extended cells.
  static CellBlock clear_block(const Cell& cell, int clearance) {
    const std::int32_t aside = (std::abs(clearance) - 1) << kShift, side = (1 << kShift) - 1;
    CellBlock block;
    for (std::size_t a = 0; a < 3; ++a) {
      block.low[a] = (cell[a] & ~side) - aside;
      block.high[a] = (cell[a] | side) + aside;
    }
    return block;
  }
  [[nodiscard]] std::size_t bytes() const { return clearance_.size(); }

 private:
  void set_signs(const ScalarGrid& grid, double isovalue, std::size_t y, std::size_t z);
  static constexpr unsigned kShift = 2;  // cells per side of a brick, as a power of two

  // The first cell of a brick along an axis.
  static std::int32_t brick_cell(std::size_t brick) { return static_cast<std::int32_t>(brick << kShift); }
  [[nodiscard]] std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return x + bricks_[0] * (y + bricks_[1] * z);
  }

  Dims dims_{};
  std::array<std::size_t, 3> bricks_{};
  std::vector<std::int8_t> clearance_;
};

}  // namespace deliso
