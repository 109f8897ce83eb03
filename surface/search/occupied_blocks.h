// The blocks of space near some points: a cheap test that shows for most small things that they are far from all
// points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

class OccupiedBlocks {
 public:
  // Precondition: at least one point. Blocks have sides of this length, or longer if there would be too many blocks.
  OccupiedBlocks(std::span<const Vec3> points, double side) {
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 sides = box.size();
    side_ = std::max(side, std::max({sides.x, sides.y, sides.z}) / kMostBlocks);
    per_side_ = 1 / side_;
    low_ = box.low;
    for (std::size_t axis = 0; axis < 3; ++axis) dims_[axis] = block_of(box.high, axis) + 2;
    is_near_.assign(dims_[0] * dims_[1] * dims_[2], false);
    std::vector<bool> is_done(is_near_.size(), false);  // of each block: most hold several points
    for (const Vec3& p : points) {
      const std::array<std::size_t, 3> at = {block_of(p, 0), block_of(p, 1), block_of(p, 2)};
      if (is_done[place(at[0], at[1], at[2])]) continue;
      is_done[place(at[0], at[1], at[2])] = true;
      for (std::size_t k = at[2] - 1; k <= at[2] + 1; ++k) {
        for (std::size_t j = at[1] - 1; j <= at[1] + 1; ++j) {
          for (std::size_t i = at[0] - 1; i <= at[0] + 1; ++i) is_near_[place(i, j, k)] = true;
        }
      }
    }
  }

  // If p is not near any point, then every point within this distance of p along each axis is none of the given ones.
  [[nodiscard]] double reach() const { return kRounding * side_; }
  [[nodiscard]] bool is_near(const Vec3& p) const {
    const std::array<std::size_t, 3> at = {block_of(p, 0), block_of(p, 1), block_of(p, 2)};
    return at[0] < dims_[0] && at[1] < dims_[1] && at[2] < dims_[2] && is_near_[place(at[0], at[1], at[2])];
  }

 private:
  static constexpr double kMostBlocks = 256;  // along an axis
  static constexpr double kRounding = 0.999;

  // Block 0 and the last block are margins. Positions beyond the low end count as block 0; those beyond the high end
  // get a number after the last block.
  [[nodiscard]] std::size_t block_of(const Vec3& p, std::size_t axis) const {
    return static_cast<std::size_t>(std::clamp((p[axis] - low_[axis]) * per_side_ + 1, 0.0, 2 * kMostBlocks));
  }
  [[nodiscard]] std::size_t place(std::size_t i, std::size_t j, std::size_t k) const {
    return i + dims_[0] * (j + dims_[1] * k);
  }

  Vec3 low_;
  double side_ = 1, per_side_ = 1;
  std::array<std::size_t, 3> dims_{};
  std::vector<bool> is_near_;
};

}  // namespace deliso
