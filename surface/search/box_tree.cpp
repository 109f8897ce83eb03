#include "surface/search/box_tree.h"

namespace deliso {

namespace {

constexpr int kTaskDepth = 4;  // subtrees of this depth are tasks
constexpr int kNoDepth = -1;

}  // namespace

// Builds the subtrees at the same time, then the nodes above them.
void BoxTree::make_nodes(int threads) {
  nodes_.resize(node_count(things_.size()));
  const Subtree all{0, 0, static_cast<std::uint32_t>(things_.size())};
  std::vector<Subtree> subtrees;
  append_subtrees(all, kTaskDepth, subtrees);
  run_tasks(subtrees.size(), things_.size() < kBlockSize ? 1 : threads,
            [&](std::size_t i) { make_nodes(subtrees[i], kNoDepth); });
  make_nodes(all, kTaskDepth);
}

// Appends the subtrees at this depth.
void BoxTree::append_subtrees(const Subtree& tree, int depth, std::vector<Subtree>& subtrees) const {
  if (depth == 0) {
    subtrees.push_back(tree);
  } else if (!tree.is_leaf()) {
    append_subtrees(tree.left(), depth - 1, subtrees);
    append_subtrees(tree.right(), depth - 1, subtrees);
  }
}

// Builds the nodes above a depth, if a depth is given. Returns the box of all.
Box3 BoxTree::make_nodes(const Subtree& tree, int depth) {
  if (depth == 0) return nodes_[tree.node].box;
  Box3 box;
  if (tree.is_leaf()) {
    for (std::uint32_t i = tree.first; i < tree.first + tree.count; ++i) include(boxes_[i], box);
    nodes_[tree.node] = {box, tree.first, tree.count};
    return box;
  }
  include(make_nodes(tree.left(), depth - 1), box);
  include(make_nodes(tree.right(), depth - 1), box);
  nodes_[tree.node] = {box, tree.right().node, 0};
  return box;
}

}  // namespace deliso
