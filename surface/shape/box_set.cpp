#include "surface/shape/box_set.h"

namespace deliso {

BoxMap::BoxMap(const std::vector<Box3>& boxes) {
  constexpr double kMostCells = 128;   // along an axis
  constexpr double kSmallestSide = 2;  // mesh-space units
  constexpr double kMargin = 1.01;     // of a cell, for rounding
  Box3 all;
  for (const Box3& box : boxes) {
    all.extend(box.low);
    all.extend(box.high);
  }
  const Vec3 size = all.size();
  side_ = std::max(kSmallestSide, std::max({size.x, size.y, size.z}) / kMostCells);
  per_side_ = 1 / side_;
  const Vec3 margin{kMargin * side_, kMargin * side_, kMargin * side_};
  low_ = all.low - margin;
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    dims_[axis] = static_cast<std::size_t>((size[axis] + 2 * margin[axis]) * per_side_) + 1;
    count *= dims_[axis];
  }
  first_.assign(count + 1, 0);
  for (const Box3& box : boxes) for_each_cell(box, [&](std::size_t cell) { ++first_[cell]; });
  for (std::size_t cell = 1; cell <= count; ++cell) first_[cell] += first_[cell - 1];
  numbers_.resize(first_.back());
  // Filled from the back, so that the boxes of a cell stay in order.
  for (auto i = static_cast<std::uint32_t>(boxes.size()); i-- > 0;) {
    for_each_cell(boxes[i], [&](std::size_t cell) { numbers_[--first_[cell]] = i; });
  }
}

// The cells that hold the low corner of something no larger than a cell that meets the box.
template <class Visit>
void BoxMap::for_each_cell(const Box3& box, const Visit& visit) const {
  constexpr double kRounding = 1e-3;  // of a cell
  std::array<std::size_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cell = [&](double x) {
      return std::min(static_cast<std::size_t>(std::max((x - low_[axis]) * per_side_, 0.0)), dims_[axis] - 1);
    };
    first[axis] = cell(box.low[axis] - (1 + kRounding) * side_);
    last[axis] = cell(box.high[axis] + kRounding * side_);
  }
  for (std::size_t k = first[2]; k <= last[2]; ++k) {
    for (std::size_t j = first[1]; j <= last[1]; ++j) {
      for (std::size_t i = first[0]; i <= last[0]; ++i) visit((k * dims_[1] + j) * dims_[0] + i);
    }
  }
}

}  // namespace deliso
