#include "surface/box_tree.h"

#include <algorithm>
#include <bit>

#include "delaunay/base/parallel.h"

namespace deliso {

// Moves the centres into the order of the leaves: the uppermost levels one after the other, then what hangs below them.
void BoxTree::build(std::vector<Centre>& centres, int threads) {
  if (centres.empty()) return;
  const std::size_t leaves = (centres.size() + kLeafSize - 1) / kLeafSize;
  nodes_.resize(2 * leaves - 1);
  std::vector<Subtree> subtrees = {{0, 0, static_cast<std::uint32_t>(centres.size())}};
  for (int depth = 0; depth < kTaskDepth; ++depth) {
    std::vector<std::pair<Subtree, Subtree>> halves(subtrees.size());
    run_tasks(subtrees.size(), threads, [&](std::size_t i) {
      if (!subtrees[i].is_leaf()) halves[i] = split(subtrees[i], centres);
    });
    std::vector<Subtree> next;
    for (std::size_t i = 0; i < subtrees.size(); ++i) {
      next.push_back(subtrees[i].is_leaf() ? subtrees[i] : halves[i].first);
      if (!subtrees[i].is_leaf()) next.push_back(halves[i].second);
    }
    subtrees = std::move(next);
  }
  run_tasks(subtrees.size(), threads, [&](std::size_t i) { build(subtrees[i], centres); });
  things_.reserve(centres.size());
  for (const Centre& centre : centres) things_.push_back(centre.thing);
}

void BoxTree::build(const Subtree& tree, std::span<Centre> centres) {
  if (tree.is_leaf()) {
    nodes_[tree.node].first = tree.first;
    nodes_[tree.node].count = tree.last - tree.first;
    return;
  }
  const auto [left, right] = split(tree, centres);
  build(left, centres);
  build(right, centres);
}

// Parts the centres of an inner node; the left subtree gets the largest power of two of leaves that leaves some for the
// right one. Equal centres are told apart by their number, so that the order is total.
std::pair<BoxTree::Subtree, BoxTree::Subtree> BoxTree::split(const Subtree& tree, std::span<Centre> centres) {
  const std::span<Centre> here = centres.subspan(tree.first, tree.last - tree.first);
  Box3 box;
  for (const Centre& centre : here) box.extend(centre.point);
  const Vec3 size = box.size();
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto leaves = static_cast<std::uint32_t>((here.size() + kLeafSize - 1) / kLeafSize);
  const std::uint32_t left_leaves = std::bit_floor(leaves - 1);
  const std::uint32_t middle = left_leaves * kLeafSize;
  std::nth_element(here.begin(), here.begin() + middle, here.end(), [axis](const Centre& a, const Centre& b) {
    return a.point[axis] < b.point[axis] || (a.point[axis] == b.point[axis] && a.thing < b.thing);
  });
  nodes_[tree.node].first = tree.node + 2 * left_leaves;
  return {{tree.node + 1, tree.first, tree.first + middle},
          {tree.node + 2 * left_leaves, tree.first + middle, tree.last}};
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
