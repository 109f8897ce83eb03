// The walk of a line through the voxel cells.
//
// Index space: sample (i, j, k) lies at (i, j, k). The *extended cells* of an axis with n samples are numbered 0 to n:
// cell e covers [e - 1, e], cell 0 everything before the first sample and cell n everything behind the last. Across
// cells 0 and n the field is constant, so a line of any length crosses at most n faces per axis and needs no clipping.
//
// One rule orders the face crossings of a line, wherever they are computed: by line parameter, and equal ones by axis.
// Consecutive cells always share a face, and both see the crossing of this face as one and the same `Crossing`. Every
// way to traverse the volume (cell by cell, or in one jump out of a block of cells) follows this order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "raycast/line.h"
#include "volume/scalar_grid.h"

namespace deliso {

using Cell = std::array<std::int32_t, 3>;

// Stands for an infinite line parameter; unlike infinity, its product with zero is zero.
inline constexpr double kNever = 1e300;

// The extended cell that holds coordinate x on an axis of n samples; the outermost one when x is not a number. No
// branches, because many points are far outside.
inline std::int32_t extended_cell(double x, std::int32_t n) {
  const double inside = std::min(std::max(0.0, x), static_cast<double>(n - 1));
  return static_cast<std::int32_t>(inside) + static_cast<std::int32_t>(x >= 0);
}

// The cell of the grid whose samples an extended cell uses.
inline Cell grid_cell(const Cell& extended, const Dims& dims) {
  return {std::clamp(extended[0] - 1, 0, dims[0] - 2), std::clamp(extended[1] - 1, 0, dims[1] - 2),
          std::clamp(extended[2] - 1, 0, dims[2] - 2)};
}

// A point where the line crosses a face, given by its parameter and the face's axis and plane; or an end of the
// segment.
struct Crossing {
  double s = 0;
  std::int32_t axis = -1;  // -1: an end of the segment
  double plane = 0;
};

// A cell, and the crossings between which the line is in it; in.s <= out.s.
struct CellVisit {
  Cell cell;
  Crossing in;
  Crossing out;
};

// Extended cells from `low` to `high`, inclusive.
struct CellBlock {
  Cell low{};
  Cell high{};
};

// Steps from cell to cell along a line: towards growing s, or (Backward) towards falling s, in the exactly reversed
// order.
template <bool Backward = false>
class CellWalk {
 public:
  // From `start`, entered at parameter s_start, to `end`, which ends at s_end. Crossings are clamped to that range.
  CellWalk(const IndexLine& line, const Cell& start, const Cell& end, double s_start, double s_end)
      : line_(&line), cell_(start), entry_{s_start, -1, 0}, key_low_(to_key(s_start)), key_high_(to_key(s_end)) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int32_t ahead = end[a] - start[a];
      step_[a] = 1 | (ahead >> 31);  // -1 when it goes back
      remaining_[a] = step_[a] * ahead;
      set_next(a);
    }
  }

  [[nodiscard]] const Cell& cell() const { return cell_; }
  // The cell with its crossings. By value: the walk itself can then live in registers.
  [[nodiscard]] CellVisit visit() const {
    return Backward ? CellVisit{cell_, exit(), entry_} : CellVisit{cell_, entry_, exit()};
  }
  // Where the walk will leave the cell; axis -1 where it ends.
  [[nodiscard]] Crossing exit() const {
    const std::size_t a = next_axis();
    if (next_[a] == kNever) return {to_key(key_high_), -1, 0};
    return {clamped(next_[a]), static_cast<std::int32_t>(a), static_cast<double>(plane_after(a, 1))};
  }

  // Goes on to the next cell; false when this was the last.
  bool step() {
    // Axis by axis, so that each branch works on fixed registers.
    if (!precedes(next_[1], 1, next_[0], 0)) {
      if (!precedes(next_[2], 2, next_[0], 0)) return step_along(0);
    } else {
      if (!precedes(next_[2], 2, next_[1], 1)) return step_along(1);
    }
    return step_along(2);
  }

  // Moves on to the first cell beyond the block, which holds the present cell. Returns false when the walk ends within
  // the block. The result is that of repeated calls of step(), found faster.
  bool leave(const CellBlock& block);

 private:
  // Crossings are compared by key: it grows along the walk.
  static double to_key(double s) { return Backward ? -s : s; }
  // Of crossings with equal keys the lower axis comes first, or last when the walk goes backward.
  static bool precedes(double key_a, std::size_t a, double key_b, std::size_t b) {
    return key_a < key_b || (key_a == key_b && (Backward ? a > b : a < b));
  }
  // The face behind the next `count` cells of an axis, count >= 1.
  [[nodiscard]] std::int32_t plane_after(std::size_t a, std::int32_t count) const {
    return cell_[a] + step_[a] * count - ((step_[a] + 1) >> 1);
  }
  [[nodiscard]] double key(std::size_t a, std::int32_t plane) const { return to_key(line_->crossing(a, plane)); }
  void set_next(std::size_t a) {
    // By table look-up, because whether this is the last step is unpredictable (compilers turn a conditional expression
    // into a branch).
    const std::array<double, 2> never_or_next = {kNever, key(a, plane_after(a, 1))};
    next_[a] = never_or_next[static_cast<std::size_t>(remaining_[a] > 0)];
  }
  [[nodiscard]] double clamped(double key) const { return to_key(std::min(std::max(key, key_low_), key_high_)); }
  [[nodiscard]] std::size_t next_axis() const {
    const std::size_t xy = precedes(next_[1], 1, next_[0], 0) ? 1 : 0;
    return precedes(next_[2], 2, next_[xy], xy) ? 2 : xy;
  }
  bool step_along(std::size_t a) {
    if (next_[a] == kNever) return false;
    entry_ = {clamped(next_[a]), static_cast<std::int32_t>(a), static_cast<double>(plane_after(a, 1))};
    cell_[a] += step_[a];
    --remaining_[a];
    set_next(a);
    return true;
  }
  // How many steps along axis b come before the crossing (key, a); at most `most`.
  [[nodiscard]] std::int32_t steps_before(std::size_t b, std::int32_t most, double key_a, std::size_t a) const;

  const IndexLine* line_;
  Cell cell_;
  Cell step_{};
  Cell remaining_{};   // steps still to do
  AxisValues next_{};  // key of the next crossing, kNever when there is none
  Crossing entry_;
  double key_low_;
  double key_high_;
};

template <bool Backward>
std::int32_t CellWalk<Backward>::steps_before(std::size_t b, std::int32_t most, double key_a, std::size_t a) const {
  if (most == 0) return 0;
  // Estimate the number from the rounded position, then correct it by the order of crossings.
  const double x = line_->base[b] + to_key(key_a) * line_->direction[b];
  const double guess = step_[b] > 0 ? std::floor(x) + 1 - cell_[b] : cell_[b] - (std::floor(x) + 1);
  auto count = static_cast<std::int32_t>(std::clamp(guess, 0.0, static_cast<double>(most)));
  while (count < most && precedes(key(b, plane_after(b, count + 1)), b, key_a, a)) ++count;
  while (count > 0 && !precedes(key(b, plane_after(b, count)), b, key_a, a)) --count;
  return count;
}

template <bool Backward>
bool CellWalk<Backward>::leave(const CellBlock& block) {
  // The first crossing out of the block.
  Cell count{};  // steps to the first cell beyond
  double key_out = kNever;
  std::size_t out = 3;
  for (std::size_t a = 0; a < 3; ++a) {
    count[a] = 1 + (step_[a] > 0 ? block.high[a] - cell_[a] : cell_[a] - block.low[a]);
    if (count[a] > remaining_[a]) continue;
    const double key_a = key(a, plane_after(a, count[a]));
    if (out < 3 && !precedes(key_a, a, key_out, out)) continue;
    key_out = key_a;
    out = a;
  }
  if (out == 3) return false;
  entry_ = {clamped(key_out), static_cast<std::int32_t>(out), static_cast<double>(plane_after(out, count[out]))};
  // All crossings before it.
  for (std::size_t a = 0; a < 3; ++a)
    if (a != out) count[a] = steps_before(a, std::min(count[a] - 1, remaining_[a]), key_out, out);
  for (std::size_t a = 0; a < 3; ++a) {
    cell_[a] += step_[a] * count[a];
    remaining_[a] -= count[a];
    set_next(a);
  }
  return true;
}

}  // namespace deliso
