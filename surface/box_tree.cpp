#include "surface/box_tree.h"

namespace deliso {

BoxTree::BoxTree(std::span<const Box3> boxes) {
  // The splits move centres, not boxes; halved terms cannot overflow.
  std::vector<Centre> centres;
  centres.reserve(boxes.size());
  for (const Box3& box : boxes) {
    centres.push_back({0.5 * box.low + 0.5 * box.high, static_cast<std::uint32_t>(centres.size())});
  }
  nodes_.reserve(boxes.size());
  things_.reserve(boxes.size());
  boxes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, centres);
}

// Appends the subtree of some things, leaves from left to right, and returns its root.
std::uint32_t BoxTree::build(std::span<const Box3> boxes, std::span<Centre> centres) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (centres.size() <= kLeafSize) {
    nodes_[node].first = static_cast<std::uint32_t>(things_.size());
    nodes_[node].count = static_cast<std::uint32_t>(centres.size());
    for (const Centre& centre : centres) {
      things_.push_back(centre.thing);
      boxes_.push_back(boxes[centre.thing]);
      nodes_[node].box.extend(boxes_.back().low);
      nodes_[node].box.extend(boxes_.back().high);
    }
    return node;
  }
  // Halve along the longest side; equal centres are told apart by their number, so that the order is total.
  Box3 box;
  for (const Centre& centre : centres) box.extend(centre.point);
  const Vec3 size = box.size();
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t half = centres.size() / 2;
  std::nth_element(centres.begin(), centres.begin() + static_cast<std::ptrdiff_t>(half), centres.end(),
                   [axis](const Centre& a, const Centre& b) {
                     return a.point[axis] < b.point[axis] || (a.point[axis] == b.point[axis] && a.thing < b.thing);
                   });
  const std::uint32_t left = build(boxes, centres.first(half));
  const std::uint32_t right = build(boxes, centres.subspan(half));
  nodes_[node].first = right;
  for (const std::uint32_t child : {left, right}) {
    nodes_[node].box.extend(nodes_[child].box.low);
    nodes_[node].box.extend(nodes_[child].box.high);
  }
  return node;
}

}  // namespace deliso
