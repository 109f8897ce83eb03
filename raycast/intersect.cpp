#include "raycast/intersect.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace deliso {

std::vector<Hit> intersect(const ScalarGrid& grid, const MinMaxKdTree& tree, double isovalue, CubicSolver solver,
                           const LineSegment& r) {
  const std::vector<CellVisit> voxels = collect_voxels(grid, tree, isovalue, r);
  return find_intersections(voxels, grid, isovalue, solver, r);
}

namespace {

// The order of crossings along the segment (cell_walk.h): by line parameter, equal ones by axis.
bool precedes(const Crossing& a, const Crossing& b) { return a.s < b.s || (a.s == b.s && a.axis < b.axis); }

// The recursive traversal of Havran, with [min, max] at every node. A node is a block of extended cells: at the
// volume's faces nodes go on outward.
class VoxelCollector {
 public:
  VoxelCollector(const ScalarGrid& grid, const MinMaxKdTree& tree, double isovalue, const LineSegment& r,
                 std::vector<CellVisit>& voxels, std::vector<NodeVisit>* nodes)
      : grid_(grid), tree_(tree), isovalue_(isovalue), r_(r), voxels_(voxels), nodes_(nodes) {}

  // The part of the segment from `in` to `out`, which lies in the node.
  void traverse(int level, const CellBlock& node, const Crossing& in, const Crossing& out) {
    // Prune the node unless min < kappa < max.
    const bool is_pruned = !can_hold_isovalue(level, node);
    if (nodes_ != nullptr) nodes_->push_back({level, node, is_pruned});
    if (is_pruned) return;
    if (node.low == node.high) {
      voxels_.push_back({node.low, clamped(in), clamped(out)});
      return;
    }

    const CellBlock lower = lower_half(level, node);
    const int below = std::max(level - 1, 0);
    const std::size_t axis = first_difference(lower.high, node.high);
    if (axis == 3) return traverse(below, node, in, out);  // the upper half lies beyond the volume
    CellBlock upper = node;
    upper.low[axis] = lower.high[axis] + 1;

    // If the segment crosses the split plane within the node, traverse both sides, the near one first. Otherwise
    // traverse the side that it lies on.
    const std::int32_t plane = lower.high[axis];
    const bool starts_low = r_.first[axis] <= plane, ends_low = r_.last[axis] <= plane;
    const CellBlock &near = starts_low ? lower : upper, &far = starts_low ? upper : lower;
    if (starts_low == ends_low) return traverse(below, near, in, out);
    const Crossing split{r_.line.crossing(axis, plane), static_cast<std::int32_t>(axis), static_cast<double>(plane)};
    if (precedes(split, in)) return traverse(below, far, in, out);
    if (precedes(out, split)) return traverse(below, near, in, out);
    traverse(below, near, in, split);
    traverse(below, far, split, out);
  }

 private:
  // A cell's own samples tell; nodes that the tree does not keep may hold anything.
  [[nodiscard]] bool can_hold_isovalue(int level, const CellBlock& node) const {
    if (node.low == node.high) return cell_holds(grid_, node.low, isovalue_);
    const bool is_kept = level >= std::max(tree_.leaf_level(), 1);
    return !is_kept || tree_.holds(isovalue_, level, grid_cell(node.low, grid_.dims()));
  }

  // The half of a node on the lower side of its split plane. At level 0 the outer cells are split off.
  [[nodiscard]] CellBlock lower_half(int level, const CellBlock& node) const {
    if (level > 0) return tree_.block(level - 1, grid_cell(node.low, grid_.dims()));
    CellBlock half = node;
    const std::size_t axis = first_difference(node.low, node.high);
    half.high[axis] = node.low[axis];
    return half;
  }

  // The first axis along which two cells differ; 3 when they are one.
  [[nodiscard]] static std::size_t first_difference(const Cell& a, const Cell& b) {
    return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
  }

  // A crossing beyond an end of the segment by rounding is at that end.
  [[nodiscard]] Crossing clamped(const Crossing& crossing) const {
    return {std::min(std::max(crossing.s, r_.s_low), r_.s_high), crossing.axis, crossing.plane};
  }

  const ScalarGrid& grid_;
  const MinMaxKdTree& tree_;
  double isovalue_;
  const LineSegment& r_;
  std::vector<CellVisit>& voxels_;
  std::vector<NodeVisit>* nodes_;
};

}  // namespace

std::vector<CellVisit> collect_voxels(const ScalarGrid& grid, const MinMaxKdTree& tree, double isovalue,
                                      const LineSegment& r, std::vector<NodeVisit>* nodes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::int32_t kEnd = -1;  // instead of an axis
  const int root = tree.root_level();
  std::vector<CellVisit> voxels;
  VoxelCollector(grid, tree, isovalue, r, voxels, nodes)
      .traverse(root, tree.block(root, {0, 0, 0}), {-kInfinity, kEnd, 0}, {kInfinity, kEnd, 0});
  return voxels;
}

std::vector<Hit> find_intersections(std::span<const CellVisit> voxels, const ScalarGrid& grid, double isovalue,
                                    CubicSolver solver, const LineSegment& r) {
  std::vector<Hit> hits;
  for (const CellVisit& voxel : voxels) find_intersections_in(voxel, grid, isovalue, solver, r, hits);
  return hits;
}

}  // namespace deliso
