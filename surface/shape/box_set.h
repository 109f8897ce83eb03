// Boxes in space: which of them another one meets, and whether one of them holds it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/refine/guard/triangle_hash_grid.h"

namespace deliso {

class BoxSet {
 public:
  void add(const Box3& box) {
    places_.add(static_cast<std::uint32_t>(boxes_.size()), box);
    boxes_.push_back(box);
  }
  [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }
  // Calls visit(i) for the boxes that meet another one. `near` holds what may be overwritten.
  template <class Visit>
  void for_each_meeting(const Box3& box, std::vector<std::uint32_t>& near, const Visit& visit) const {
    near.clear();
    places_.append_near(box, near);
    for (const std::uint32_t i : near) {
      if (boxes_[i].meets(box)) visit(i);
    }
  }
  [[nodiscard]] bool holds(const Box3& box, std::vector<std::uint32_t>& near) const {
    near.clear();
    places_.append_near(box, near);
    return std::any_of(near.begin(), near.end(),
                       [&](std::uint32_t i) { return boxes_[i].contains(box.low) && boxes_[i].contains(box.high); });
  }

 private:
  std::vector<Box3> boxes_;
  TriangleHashGrid places_;
};

// A coarse map of boxes: those near a point, for things that are small.
class BoxMap {
 public:
  explicit BoxMap(const std::vector<Box3>& boxes);

  // A thing no larger than this along each axis meets only boxes near its low corner.
  [[nodiscard]] double reach() const { return side_; }
  [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& p) const {
    std::size_t place = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const double at = (p[axis] - low_[axis]) * per_side_;
      if (!(at >= 0) || !(at < static_cast<double>(dims_[axis]))) return {};
      place = place * dims_[axis] + static_cast<std::size_t>(at);
    }
    return std::span(numbers_).subspan(first_[place], first_[place + 1] - first_[place]);
  }

  // Calls visit(i), for some boxes several times, for those that a larger thing may meet; false if it is so large that
  // this takes too long.
  template <class Visit>
  [[nodiscard]] bool visit_near(const Box3& thing, const Visit& visit) const {
    constexpr std::size_t kMostCells = 64;
    std::array<std::size_t, 3> first{}, last{};
    std::size_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = (thing.low[axis] - low_[axis]) * per_side_, high = (thing.high[axis] - low_[axis]) * per_side_;
      if (!(high >= 0) || !(low < static_cast<double>(dims_[axis]))) return true;
      first[axis] = static_cast<std::size_t>(std::max(low, 0.0));
      last[axis] = static_cast<std::size_t>(std::min(high, static_cast<double>(dims_[axis] - 1)));
      cells *= last[axis] - first[axis] + 1;
    }
    if (cells > kMostCells) return false;
    for (std::size_t k = first[2]; k <= last[2]; ++k) {
      for (std::size_t j = first[1]; j <= last[1]; ++j) {
        // The lists of cells in a row follow one another.
        const std::size_t row = (k * dims_[1] + j) * dims_[0];
        for (std::uint32_t at = first_[row + first[0]]; at < first_[row + last[0] + 1]; ++at) visit(numbers_[at]);
      }
    }
    return true;
  }

 private:
  template <class Visit>
  void for_each_cell(const Box3& box, const Visit& visit) const;

  Vec3 low_;
  double side_ = 1, per_side_ = 1;
  std::array<std::size_t, 3> dims_{};
  std::vector<std::uint32_t> first_;    // of each cell, x fastest: where its boxes begin
  std::vector<std::uint32_t> numbers_;  // of the boxes, cell by cell
};

}  // namespace deliso
