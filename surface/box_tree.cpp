#include "surface/box_tree.h"

#include <bit>

#include "delaunay/base/parallel.h"

namespace deliso {

BoxTree::BoxTree(std::span<const Box3> boxes, int threads) : things_(boxes.size()), boxes_(boxes.size()) {
  if (boxes.empty()) return;
  // The splits move centres, not boxes; halved terms cannot overflow.
  std::vector<Centre> centres;
  centres.reserve(boxes.size());
  for (const Box3& box : boxes) {
    centres.push_back({0.5 * box.low + 0.5 * box.high, static_cast<std::uint32_t>(centres.size())});
  }
  const std::size_t leaves = (boxes.size() + kLeafSize - 1) / kLeafSize;
  nodes_.resize(2 * leaves - 1);
  // The uppermost levels one after the other, then what hangs below them.
  std::vector<Subtree> subtrees = {{0, 0, static_cast<std::uint32_t>(boxes.size())}};
  std::vector<std::uint32_t> upper;
  for (int depth = 0; depth < kTaskDepth; ++depth) {
    std::vector<std::pair<Subtree, Subtree>> halves(subtrees.size());
    run_tasks(subtrees.size(), threads, [&](std::size_t i) {
      if (!subtrees[i].is_leaf()) halves[i] = split(subtrees[i], centres);
    });
    std::vector<Subtree> next;
    for (std::size_t i = 0; i < subtrees.size(); ++i) {
      if (subtrees[i].is_leaf()) {
        next.push_back(subtrees[i]);
      } else {
        upper.push_back(subtrees[i].node);
        next.push_back(halves[i].first);
        next.push_back(halves[i].second);
      }
    }
    subtrees = std::move(next);
  }
  run_tasks(subtrees.size(), threads, [&](std::size_t i) { build(subtrees[i], boxes, centres); });
  std::for_each(upper.rbegin(), upper.rend(), [&](std::uint32_t node) { enclose_children(node); });
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

void BoxTree::build(const Subtree& tree, std::span<const Box3> boxes, std::span<Centre> centres) {
  if (tree.is_leaf()) return fill_leaf(tree, boxes, centres);
  const auto [left, right] = split(tree, centres);
  build(left, boxes, centres);
  build(right, boxes, centres);
  enclose_children(tree.node);
}

void BoxTree::fill_leaf(const Subtree& leaf, std::span<const Box3> boxes, std::span<const Centre> centres) {
  Node& node = nodes_[leaf.node];
  node.first = leaf.first;
  node.count = leaf.last - leaf.first;
  for (std::uint32_t i = leaf.first; i < leaf.last; ++i) {
    things_[i] = centres[i].thing;
    boxes_[i] = boxes[things_[i]];
    node.box.extend(boxes_[i].low);
    node.box.extend(boxes_[i].high);
  }
}

void BoxTree::enclose_children(std::uint32_t node) {
  for (const std::uint32_t child : {node + 1, nodes_[node].first}) {
    nodes_[node].box.extend(nodes_[child].box.low);
    nodes_[node].box.extend(nodes_[child].box.high);
  }
}

std::vector<BoxTree::PairTask> BoxTree::pair_tasks() const {
  std::vector<PairTask> tasks;
  if (!nodes_.empty()) append_tasks(0, kTaskDepth, tasks);
  return tasks;
}

void BoxTree::append_tasks(std::uint32_t node, int depth, std::vector<PairTask>& tasks) const {
  if (depth == 0 || nodes_[node].count != 0) {
    tasks.push_back({node, node});
    return;
  }
  append_tasks(node + 1, depth - 1, tasks);
  append_tasks(nodes_[node].first, depth - 1, tasks);
  tasks.push_back({node + 1, nodes_[node].first});
}

}  // namespace deliso
