// A tree of axis-aligned boxes over any things that have one: which of them meet a box, which is nearest.
//
// Splits along the longest side of the centres' box, such that every left subtree is complete: so the places of all
// nodes, in depth-first order, are known beforehand, and subtrees can be built on several threads.
// Deterministic; results do not depend on rounding because boxes are only copied and merged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

class BoxTree {
 public:
  explicit BoxTree(std::span<const Box3> boxes, int threads = 1)
      : BoxTree(
            boxes.size(), [boxes](std::size_t i) { return boxes[i]; }, threads) {}

  // Of `count` things; box_of(i) gives the box of thing i, always the same.
  template <class BoxOf>
  BoxTree(std::size_t count, BoxOf&& box_of, int threads = 1) {
    std::vector<Centre> centres(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Box3 box = box_of(i);
      // Halved terms cannot overflow.
      centres[i] = {0.5 * box.low + 0.5 * box.high, static_cast<std::uint32_t>(i)};
    }
    build(centres, threads);
    boxes_.reserve(count);
    for (const std::uint32_t thing : things_) boxes_.push_back(box_of(thing));
    enclose();
  }

  // Calls visit(i) for each box that has a point in common with `box`, faces included.
  template <class Visit>
  void for_each_meeting(const Box3& box, Visit&& visit) const;

  // The thing nearest to p among those nearer than sqrt(bound), with its squared distance; {kNone, bound} when there is
  // none. measure(i) gives the squared distance of thing i from p.
  template <class Measure>
  [[nodiscard]] std::pair<std::uint32_t, double> nearest(const Vec3& p, double bound, Measure&& measure) const {
    return least(
        bound, [&](const Box3& box) { return squared_gap(box, p); }, measure);
  }

  // The thing with the least measure below `bound`, with its measure; {kNone, bound} when there is none. No thing in a
  // box may measure less than gap(box).
  template <class Gap, class Measure>
  [[nodiscard]] std::pair<std::uint32_t, double> least(double bound, Gap&& gap, Measure&& measure) const;

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

 private:
  static constexpr std::uint32_t kLeafSize = 8;
  static constexpr int kTaskDepth = 4;          // subtrees of this depth are tasks
  static constexpr std::size_t kMaxDepth = 64;  // halving 2^32 things stops long before

  struct Node {
    Box3 box;
    std::uint32_t first = 0;  // leaf: its first place in things_; inner node: its right child
    std::uint32_t count = 0;  // leaf: number of things; inner node: 0
  };

  static double squared_gap(const Box3& box, const Vec3& p) { return squared_distance(p, box.clamp(p)); }

  struct Centre {
    Vec3 point;
    std::uint32_t thing = 0;
  };
  // The subtree of things first to last of the order of leaves, with its root at a place in nodes_.
  struct Subtree {
    std::uint32_t node = 0, first = 0, last = 0;
    [[nodiscard]] bool is_leaf() const { return last - first <= kLeafSize; }
  };
  void build(std::vector<Centre>& centres, int threads);
  void build(const Subtree& tree, std::span<Centre> centres);
  std::pair<Subtree, Subtree> split(const Subtree& tree, std::span<Centre> centres);
  void enclose();

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> things_;  // in the order of the leaves
  std::vector<Box3> boxes_;            // of things_, in the same order
};

template <class Visit>
void BoxTree::for_each_meeting(const Box3& box, Visit&& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kMaxDepth> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    const Node& n = nodes_[node];
    if (!n.box.meets(box)) continue;
    if (n.count == 0) {
      stack[depth++] = n.first;
      stack[depth++] = node + 1;
      continue;
    }
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      if (boxes_[i].meets(box)) visit(things_[i]);
    }
  }
}

template <class Gap, class Measure>
std::pair<std::uint32_t, double> BoxTree::least(double bound, Gap&& gap, Measure&& measure) const {
  std::pair<std::uint32_t, double> best = {kNone, bound};
  if (nodes_.empty()) return best;
  // Nodes still to be visited, with their gap; the child with the smaller one is visited first.
  std::array<std::pair<double, std::uint32_t>, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = {gap(nodes_[0].box), 0};
  while (depth > 0) {
    const auto [least_possible, node] = stack[--depth];
    if (least_possible >= best.second) continue;
    const Node& n = nodes_[node];
    if (n.count == 0) {
      std::pair<double, std::uint32_t> near = {gap(nodes_[node + 1].box), node + 1};
      std::pair<double, std::uint32_t> far = {gap(nodes_[n.first].box), n.first};
      if (far.first < near.first) std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
      continue;
    }
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      if (gap(boxes_[i]) >= best.second) continue;
      const double measured = measure(things_[i]);
      if (measured < best.second) best = {things_[i], measured};
    }
  }
  return best;
}

}  // namespace deliso
