#include "surface/repair/diagnosis/index_ranges.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace deliso {

namespace {

std::int32_t distance_from(const LayerRange& range, std::int32_t layer) {
  return std::max({range.first - layer, layer - range.last, 0});
}

// Along the axis along which it is largest.
std::int32_t distance_from(const IndexBox& box, const CellIndex& cell) {
  std::int32_t farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) farthest = std::max(farthest, distance_from(box[axis], cell[axis]));
  return farthest;
}

}  // namespace

DistanceFromRanges::DistanceFromRanges(std::vector<IndexBox> boxes, const std::array<std::int32_t, 3>& dims,
                                       std::int32_t reach)
    : boxes_(std::move(boxes)), reach_(reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at_least_[axis].assign(static_cast<std::size_t>(dims[axis]), std::numeric_limits<std::int32_t>::max());
    for (std::int32_t layer = 0; layer < dims[axis]; ++layer) {
      std::int32_t& nearest = at_least_[axis][static_cast<std::size_t>(layer)];
      for (const IndexBox& box : boxes_) nearest = std::min(nearest, distance_from(box[axis], layer));
    }
  }
}

std::int32_t DistanceFromRanges::operator()(const CellIndex& cell) const {
  std::int32_t at_least = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at_least = std::max(at_least, at_least_[axis][static_cast<std::size_t>(cell[axis])]);
  }
  if (at_least > reach_ || boxes_.size() == 1) return at_least;
  std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
  for (const IndexBox& box : boxes_) nearest = std::min(nearest, distance_from(box, cell));
  return nearest;
}

}  // namespace deliso
