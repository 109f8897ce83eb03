// A tree of axis-aligned boxes over any things with a box: it finds those whose boxes meet a box, and the nearest one.
//
// The things are stored in the order of repeated halving (surface/search/kd_order.h), whose parts are the nodes.
// Results do not depend on the rounding of that order: boxes are only copied and merged, and among equals the first
// thing is taken.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"
#include "surface/search/kd_order.h"

namespace deliso {

class BoxTree {
 public:
  explicit BoxTree(std::span<const Box3> boxes, int threads = 1)
      : BoxTree(
            boxes.size(), [boxes](std::size_t i) { return boxes[i]; }, threads) {}

  // For `count` things; box_of(i) gives the box of thing i, always the same, from any thread.
  template <class BoxOf>
  BoxTree(std::size_t count, BoxOf&& box_of, int threads = 1) {
    if (count == 0) return;
    std::vector<Vec3> centres(count);
    std::vector<Box3> of_blocks((count - 1) / kBlockSize + 1);
    for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Box3 box = box_of(i);
        centres[i] = 0.5 * box.low + 0.5 * box.high;  // halved terms cannot overflow
        of_blocks[first / kBlockSize].extend(centres[i]);
      }
    });
    Box3 all;
    for (const Box3& block : of_blocks) include(block, all);
    const CentreLattice lattice(all);
    std::vector<LatticePlace> places(count);
    for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) places[i] = lattice.place(centres[i], i);
    });
    things_ = kd_order(
        std::move(places), [&](std::uint32_t thing) { return centres[thing]; }, threads);
    boxes_.resize(count);
    for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) boxes_[i] = box_of(things_[i]);
    });
    make_nodes(threads);
  }

  // Calls visit(i) for each box that has a point in common with `box`, faces included.
  template <class Visit>
  void for_each_meeting(const Box3& box, Visit&& visit) const;

  // The nearest to p of the things nearer than sqrt(bound), with its squared distance; {kNone, bound} when there is
  // none. measure(i) gives the squared distance of thing i from p. Among equally distant things the first is taken.
  template <class Measure>
  [[nodiscard]] std::pair<std::uint32_t, double> nearest(const Vec3& p, double bound, Measure&& measure) const {
    return least(
        bound, [&](const Box3& box) { return squared_gap(box, p); }, measure);
  }

  // The thing with the least measure below `bound` (the first of equals), with its measure; {kNone, bound} when there
  // is none. Precondition: gap(box) is a lower bound of the measure of any thing in the box.
  template <class Gap, class Measure>
  [[nodiscard]] std::pair<std::uint32_t, double> least(double bound, Gap&& gap, Measure&& measure) const;

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

 private:
  static constexpr std::size_t kMaxDepth = 64;  // repeated halving of 2^32 things ends long before

  struct Node {
    Box3 box;
    std::uint32_t first = 0;  // leaf: index of its first thing in things_; inner node: its right child
    std::uint32_t count = 0;  // leaf: number of things; inner node: 0
  };

  static double squared_gap(const Box3& box, const Vec3& p) { return squared_distance(p, box.clamp(p)); }

  // A subtree: its first node, and its things.
  struct Subtree {
    std::uint32_t node = 0;
    std::uint32_t first = 0;  // index in things_
    std::uint32_t count = 0;

    [[nodiscard]] bool is_leaf() const { return count <= kThingsPerLeaf; }
    [[nodiscard]] Subtree left() const { return {node + 1, first, left_half(count)}; }
    [[nodiscard]] Subtree right() const {
      const std::uint32_t there = left_half(count);
      return {node + 1 + node_count(there), first + there, count - there};
    }
  };
  // All leaves except the last of a part are full (kd_order.h).
  static std::uint32_t node_count(std::size_t things) {
    return static_cast<std::uint32_t>(2 * ((things + kThingsPerLeaf - 1) / kThingsPerLeaf) - 1);
  }
  static void include(const Box3& part, Box3& box) {
    box.extend(part.low);
    box.extend(part.high);
  }

  void make_nodes(int threads);
  void append_subtrees(const Subtree& tree, int depth, std::vector<Subtree>& subtrees) const;
  Box3 make_nodes(const Subtree& tree, int depth);

  std::vector<Node> nodes_;            // depth first, left before right
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
    if (least_possible > best.second) continue;
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
      if (gap(boxes_[i]) > best.second) continue;
      const double measured = measure(things_[i]);
      const bool is_first_of_equals = measured == best.second && best.first != kNone && things_[i] < best.first;
      if (measured < best.second || is_first_of_equals) best = {things_[i], measured};
    }
  }
  return best;
}

}  // namespace deliso
