#include "surface/box_tree.h"

namespace deliso {

void BoxTree::build() {
  if (things_.empty()) return;
  const std::size_t leaves = (things_.size() + kThingsPerLeaf - 1) / kThingsPerLeaf;
  nodes_.resize(2 * leaves - 1);
  lay_out(0, 0, static_cast<std::uint32_t>(things_.size()));
  enclose();
}

// The nodes of the things first to last of the order of leaves, in depth-first order.
void BoxTree::lay_out(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
  if (last - first <= kThingsPerLeaf) {
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    return;
  }
  const std::uint32_t left = left_half(last - first);
  nodes_[node].first = node + 2 * (left / kThingsPerLeaf);
  lay_out(node + 1, first, first + left);
  lay_out(nodes_[node].first, first + left, last);
}

// The boxes of nodes, children first: they come after their parents.
void BoxTree::enclose() {
  for (auto node = static_cast<std::uint32_t>(nodes_.size()); node-- > 0;) {
    Node& n = nodes_[node];
    const auto include = [&n](const Box3& box) {
      n.box.extend(box.low);
      n.box.extend(box.high);
    };
    if (n.count == 0) {
      include(nodes_[node + 1].box);
      include(nodes_[n.first].box);
    }
    for (std::uint32_t i = 0; i < n.count; ++i) include(boxes_[n.first + i]);
  }
}

}  // namespace deliso
