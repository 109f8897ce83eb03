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
  PointGrid() = default;
  // Cubes have sides of this length, or longer if there would be too many.
  PointGrid(std::span<const Vec3> points, double side)
      : PointGrid(
            points.size(), [&](std::size_t i) { return points[i]; }, side) {}
  // The same for the points that point(i) gives for numbers below `count`.
  template <class Point>
  PointGrid(std::size_t count, const Point& point, double side) {
    if (count == 0) return;
    Box3 box;
    for (std::size_t i = 0; i < count; ++i) box.extend(point(i));
    const Vec3 sides = box.high - box.low;
    side = std::max(side, std::max({sides.x, sides.y, sides.z}) / kMostBlocks);
    side = std::max(side, std::cbrt(sides.x * sides.y * sides.z / (kMostPerPoint * static_cast<double>(count))));
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
    for (std::size_t i = 0; i < count; ++i) ++first_[block_of(point(i))];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    points_.resize(count);
    // Filled from the back, so that the points of a block stay in order.
    for (auto i = static_cast<std::uint32_t>(count); i-- > 0;) points_[--first_[block_of(point(i))]] = i;
  }

  // The points block by block, those of a block in their order.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return points_; }
  // Whether test(place), of a place in order(), holds for some point in the block that p lies in.
  template <class Test>
  [[nodiscard]] bool any_place_beside(const Vec3& p, Test&& test) const {
    const auto [first, last] = places_beside(p);
    for (std::uint32_t at = first; at < last; ++at) {
      if (test(at)) return true;
    }
    return false;
  }
  // The same for all points in a box, and some others around it.
  template <class Test>
  [[nodiscard]] bool any_place_near(const Box3& box, Test&& test) const {
    if (points_.empty()) return false;
    std::array<std::size_t, 3> first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = place(box.low, axis), high = place(box.high, axis);
      if (!(high >= 0) || !(low < static_cast<double>(dims_[axis]))) return false;
      first[axis] = static_cast<std::size_t>(std::max(low, 0.0));
      last[axis] = static_cast<std::size_t>(std::min(high, static_cast<double>(dims_[axis] - 1)));
    }
    for (std::size_t k = first[2]; k <= last[2]; ++k) {
      for (std::size_t j = first[1]; j <= last[1]; ++j) {
        const std::uint32_t end = first_[row(j, k) + last[0] + 1];
        for (std::uint32_t at = first_[row(j, k) + first[0]]; at < end; ++at) {
          if (test(at)) return true;
        }
      }
    }
    return false;
  }

  // Calls visit(i) for the points in the block that p lies in.
  template <class Visit>
  void for_each_beside(const Vec3& p, Visit&& visit) const {
    const auto [first, last] = places_beside(p);
    for (std::uint32_t at = first; at < last; ++at) visit(points_[at]);
  }

  // Calls visit(i) for all points in a box, and for some others around it.
  template <class Visit>
  void for_each_near(const Box3& box, Visit&& visit) const {
    static_cast<void>(any_place_near(box, [&](std::uint32_t at) {
      visit(points_[at]);
      return false;
    }));
  }

 private:
  static constexpr double kMostBlocks = 128;  // along an axis, or one more
  static constexpr double kMostPerPoint = 64;

  // The first place of the block that p lies in, and the one after its last.
  [[nodiscard]] std::array<std::uint32_t, 2> places_beside(const Vec3& p) const {
    std::array<std::size_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double where = points_.empty() ? -1 : place(p, axis);
      if (!(where >= 0) || !(where < static_cast<double>(dims_[axis]))) return {};
      at[axis] = static_cast<std::size_t>(where);
    }
    const std::size_t block = row(at[1], at[2]) + at[0];
    return {first_[block], first_[block + 1]};
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
