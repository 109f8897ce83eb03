#include "surface/box_tree.h"

#include <numeric>

namespace deliso {

namespace {

// Halved terms cannot overflow.
double centre(const Box3& box, std::size_t axis) { return 0.5 * box.low[axis] + 0.5 * box.high[axis]; }

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes) : things_(boxes.size()) {
  std::iota(things_.begin(), things_.end(), 0u);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
  boxes_.reserve(boxes.size());
  for (const std::uint32_t thing : things_) boxes_.push_back(boxes[thing]);
}

void BoxTree::build(std::span<const Box3> boxes, std::uint32_t first, std::uint32_t last) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  Box3 box, centres;
  for (std::uint32_t i = first; i < last; ++i) {
    const Box3& b = boxes[things_[i]];
    box.extend(b.low);
    box.extend(b.high);
    centres.extend({centre(b, 0), centre(b, 1), centre(b, 2)});
  }
  nodes_[node].box = box;
  if (last - first <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    return;
  }
  // Halve along the longest side; equal centres are told apart by their number, so that the order is total.
  const Vec3 size = centres.size();
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(things_.begin() + first, things_.begin() + middle, things_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = centre(boxes[a], axis), cb = centre(boxes[b], axis);
                     return ca < cb || (ca == cb && a < b);
                   });
  build(boxes, first, middle);
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, middle, last);
}

}  // namespace deliso
