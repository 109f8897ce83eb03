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
