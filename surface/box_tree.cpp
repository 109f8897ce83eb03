#include "surface/box_tree.h"

namespace deliso {

Box3 BoxTree::make_nodes(std::uint32_t first, std::uint32_t count) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  Box3 box;
  const auto include = [&box](const Box3& part) {
    box.extend(part.low);
    box.extend(part.high);
  };
  if (count <= kThingsPerLeaf) {
    for (std::uint32_t i = first; i < first + count; ++i) include(boxes_[i]);
    nodes_[node] = {box, first, count};
    return box;
  }
  const std::uint32_t left = left_half(count);
  include(make_nodes(first, left));
  const auto right_child = static_cast<std::uint32_t>(nodes_.size());
  include(make_nodes(first + left, count - left));
  nodes_[node] = {box, right_child, 0};
  return box;
}

}  // namespace deliso
