// How far the isosurface is, by bricks of 4 x 4 x 4 extended cells: one signed byte each, small enough for the caches.
//
// Most points that a mesher asks about lie far from the surface, and one look at this table tells their side; most
// segments lie far from it too, and a step or two from empty block to empty block tell that they have no hit.
#pragma once

#include <cstdint>
#include <vector>

#include "raycast/active_cells.h"
#include "raycast/cell_walk.h"
#include "volume/scalar_grid.h"

namespace deliso {

class EmptyBricks {
 public:
  // `active` has been made for this grid and isovalue.
  EmptyBricks(const ScalarGrid& grid, const ActiveCells& active, double isovalue);

  // 0 when the cell's brick has an active cell. Otherwise plus or minus d >= 1: all bricks up to d - 1 away from it in
  // every direction have none, and the field in them is above (plus) or below the isovalue.
  [[nodiscard]] int clearance(const Cell& cell) const {
    return clearance_[index(static_cast<std::size_t>(cell[0]) >> kShift, static_cast<std::size_t>(cell[1]) >> kShift,
                            static_cast<std::size_t>(cell[2]) >> kShift)];
  }

  // True only when no cell within 1e-5 voxels (in every direction) of the segment from a to b, both in index space, is
  // active. False tells nothing.
  [[nodiscard]] bool is_clear(const AxisValues& a, const AxisValues& b) const;
  // The same for the box that a and b span.
  [[nodiscard]] bool is_clear_box(const AxisValues& a, const AxisValues& b) const;

  [[nodiscard]] std::size_t bytes() const { return clearance_.size(); }

 private:
  static constexpr unsigned kShift = 2;  // cells per side of a brick, as a power of two
  static constexpr int kFarthest = 24;   // greater distances count as this one

  // The first cell of a brick along an axis.
  static std::int32_t brick_cell(std::size_t brick) { return static_cast<std::int32_t>(brick << kShift); }
  // The empty block around a point, in index space, a little smaller than it is. False when the point's brick is not
  // empty, or the point so close to the side of the block that it lies in that margin.
  bool empty_block(const AxisValues& p, AxisValues& low, AxisValues& high) const;
  [[nodiscard]] std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return x + bricks_[0] * (y + bricks_[1] * z);
  }

  Dims dims_{};
  std::array<std::size_t, 3> bricks_{};
  std::vector<std::int8_t> clearance_;
};

}  // namespace deliso
