// Points sorted into cubes of space, to find those near a small box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

class PointGrid {
 public:
  // Cubes have sides of this length, or longer if there would be too many.
  PointGrid(std::span<const Vec3> points, double side) {
    if (points.empty()) return;
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 sides = box.high - box.low;
    side = std::max(side, std::max({sides.x, sides.y, sides.z}) / kMostBlocks);
    side =
        std::max(side, std::cbrt(sides.x * sides.y * sides.z / (kMostPerPoint * static_cast<double>(points.size()))));
    low_ = box.low;
    per_side_ = 1 / side;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      dims_[axis] = static_cast<std::size_t>(sides[axis] * per_side_) + 1;
    }
    const auto block_of = [&](const Vec3& p) {
      const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(place(p, axis)); };
      return row(at(1), at(2)) + at(0);
    };
    first_.assign(row(0, dims_[2]) + 1, 0);
    for (const Vec3& p : points) ++first_[block_of(p)];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    points_.resize(points.size());
    // Filled from the back, so that the points of a block stay in order.
    for (auto i = static_cast<std::uint32_t>(points.size()); i-- > 0;) points_[--first_[block_of(points[i])]] = i;
  }

  // Calls visit(i) for the points in the block that p lies in.
  template <class Visit>
  void for_each_beside(const Vec3& p, Visit&& visit) const {
    for (const std::uint32_t i : beside(p)) visit(i);
  }

  // Whether test(i) holds for some point in the block that p lies in.
  template <class Test>
  [[nodiscard]] bool any_beside(const Vec3& p, Test&& test) const {
    const std::span<const std::uint32_t> near = beside(p);
    return std::any_of(near.begin(), near.end(), test);
  }

  // Calls visit(i) for all points in a box, and for some others around it.
  template <class Visit>
  void for_each_near(const Box3& box, Visit&& visit) const {
    if (points_.empty()) return;
    std::array<std::size_t, 3> first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = place(box.low, axis), high = place(box.high, axis);
      if (!(high >= 0) || !(low < static_cast<double>(dims_[axis]))) return;
      first[axis] = static_cast<std::size_t>(std::max(low, 0.0));
      last[axis] = static_cast<std::size_t>(std::min(high, static_cast<double>(dims_[axis] - 1)));
    }
    for (std::size_t k = first[2]; k <= last[2]; ++k) {
      for (std::size_t j = first[1]; j <= last[1]; ++j) {
        const std::uint32_t end = first_[row(j, k) + last[0] + 1];
        for (std::uint32_t at = first_[row(j, k) + first[0]]; at < end; ++at) visit(points_[at]);
      }
    }
  }

 private:
  static constexpr double kMostBlocks = 128;  // along an axis, or one more
  static constexpr double kMostPerPoint = 64;

  // The points in the block that p lies in.
  [[nodiscard]] std::span<const std::uint32_t> beside(const Vec3& p) const {
    std::array<std::size_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double where = points_.empty() ? -1 : place(p, axis);
      if (!(where >= 0) || !(where < static_cast<double>(dims_[axis]))) return {};
      at[axis] = static_cast<std::size_t>(where);
    }
    const std::size_t block = row(at[1], at[2]) + at[0];
    return std::span(points_).subspan(first_[block], first_[block + 1] - first_[block]);
  }
  // In block sides, from the lowest block.
  [[nodiscard]] double place(const Vec3& p, std::size_t axis) const { return (p[axis] - low_[axis]) * per_side_; }
  [[nodiscard]] std::size_t row(std::size_t j, std::size_t k) const { return dims_[0] * (j + dims_[1] * k); }

  Vec3 low_;
  double per_side_ = 1;
  std::array<std::size_t, 3> dims_{};
  std::vector<std::uint32_t> first_;   // of each block: index of its first point in points_
  std::vector<std::uint32_t> points_;  // block by block
};

}  // namespace deliso
