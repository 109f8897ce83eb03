// Pairs of boxes that may meet, among many.
//
// Boxes near each other in space are stored near each other, in the order of repeated halving
// (surface/search/kd_order.h). Eight consecutive boxes form a block, eight blocks a block of the next level, up to a
// single one. A block stores the boxes of its eight parts side by side, so that a box is compared with all of them at
// once. Only blocks of the same level are compared.
//
// Floats take half the time of doubles. Rounding to floats keeps the order of numbers, so boxes that have a point in
// common still have one. But boxes whose distance is below the rounding, about 2^-24 of the whole, also seem to have
// one. So doubles are needed where many boxes are smaller than that.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/lane_bits.h"

namespace deliso {

inline constexpr std::size_t kBoxesPerRow = 8;

// Three labels for each of eight consecutive boxes, side by side. Two boxes with a common label do not count as a pair.
// A label with the top bit set is ignored.
class LabelRow {
 public:
  static constexpr std::uint32_t kVoid = 1U << 31;
  using Labels = std::array<std::uint32_t, 3>;

  void set(std::size_t i, const Labels& labels) {
    for (std::size_t k = 0; k < 3; ++k) labels_[k][i] = labels[k];
  }
  [[nodiscard]] Labels of(std::size_t i) const { return {labels_[0][i], labels_[1][i], labels_[2][i]}; }
  // Bit i: whether box i shares a label with box k of another row.
  [[nodiscard]] std::uint32_t sharing(const LabelRow& other, std::size_t k) const {
    const std::uint32_t x = other.valid(0, k), y = other.valid(1, k), z = other.valid(2, k);
    return bits_where<kBoxesPerRow>([&](std::size_t i) {
      const std::uint32_t a = labels_[0][i], b = labels_[1][i], c = labels_[2][i];
      return mask_of(a == x) | mask_of(a == y) | mask_of(a == z) | mask_of(b == x) | mask_of(b == y) | mask_of(b == z) |
             mask_of(c == x) | mask_of(c == y) | mask_of(c == z);
    });
  }
  // The same within this row, for the label of box 0 that the most boxes share.
  [[nodiscard]] std::uint32_t sharing_one() const {
    std::uint32_t most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t label = valid(k, 0);
      const std::uint32_t bits = bits_where<kBoxesPerRow>([&](std::size_t i) {
        return mask_of(labels_[0][i] == label) | mask_of(labels_[1][i] == label) | mask_of(labels_[2][i] == label);
      });
      if (std::popcount(bits) > std::popcount(most)) most = bits;
    }
    return most;
  }

 private:
  // Label k of box i; for an ignored label the largest number, which equals no label.
  [[nodiscard]] std::uint32_t valid(std::size_t k, std::size_t i) const {
    const std::uint32_t label = labels_[k][i];
    return label < kVoid ? label : ~0U;
  }

  std::array<std::array<std::uint32_t, kBoxesPerRow>, 3> labels_{};
};

template <class Real>
class BoxPairs {
 public:
  // For `count` boxes; box_of(i) gives the box at index i, none has a point below `low`. Empty boxes are in no pair.
  // `labels`: rows of eight in the same order, kept as a reference.
  template <class BoxOf>
  BoxPairs(std::size_t count, const Vec3& low, std::span<const LabelRow> labels, BoxOf&& box_of) : labels_(labels) {
    if (count == 0) return;
    levels_.emplace_back((count + kParts - 1) / kParts);
    for (std::size_t i = 0; i < count; ++i) levels_[0][i / kParts].set(i % kParts, rounded(box_of(i), low));
    enclose();
  }

  // A set of pairs that can be searched independently of all others.
  struct Task {
    std::uint32_t level = 0, a = 0, b = 0;  // blocks; the same for pairs within one
  };
  [[nodiscard]] std::vector<Task> tasks() const;

  // Calls visit(i, j) once for each pair of the task whose boxes have a point in common, faces included, and no common
  // label. With floats it also visits boxes whose distance is below the rounding.
  template <class Visit>
  void for_each(const Task& task, Visit&& visit) const {
    task.a == task.b ? within(task.level, task.a, visit) : between(task.level, task.a, task.b, visit);
  }

 private:
  static constexpr std::uint32_t kParts = kBoxesPerRow;
  static constexpr std::size_t kTaskBlocks = 64;  // tasks begin at a level of at least so many blocks

  struct Bounds {
    std::array<Real, 3> low{}, high{};
  };
  // The boxes of eight parts, coordinate by coordinate; missing parts are empty.
  struct Block {
    std::array<std::array<Real, kParts>, 3> low, high;

    Block() {
      for (auto& row : low) row.fill(std::numeric_limits<Real>::infinity());
      for (auto& row : high) row.fill(-std::numeric_limits<Real>::infinity());
    }
    void set(std::size_t part, const Bounds& bounds) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k][part] = bounds.low[k];
        high[k][part] = bounds.high[k];
      }
    }
    [[nodiscard]] Bounds bounds() const;
    // Bit i: whether part i meets part j of another block.
    [[nodiscard]] std::uint32_t meeting(const Block& other, std::size_t j) const {
      const std::array<Real, 3> other_low = {other.low[0][j], other.low[1][j], other.low[2][j]};
      const std::array<Real, 3> other_high = {other.high[0][j], other.high[1][j], other.high[2][j]};
      return bits_where<kBoxesPerRow>([&](std::size_t i) {
        const std::uint32_t x = mask_of(low[0][i] <= other_high[0]) & mask_of(other_low[0] <= high[0][i]);
        const std::uint32_t y = mask_of(low[1][i] <= other_high[1]) & mask_of(other_low[1] <= high[1][i]);
        const std::uint32_t z = mask_of(low[2][i] <= other_high[2]) & mask_of(other_low[2] <= high[2][i]);
        return x & y & z;
      });
    }
  };

  static Bounds rounded(const Box3& box, const Vec3& low) {
    if constexpr (std::is_same_v<Real, double>) {
      return {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}};
    } else {
      const Vec3 a = box.low - low, b = box.high - low;
      return {{static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z)},
              {static_cast<Real>(b.x), static_cast<Real>(b.y), static_cast<Real>(b.z)}};
    }
  }
  void enclose();

  template <class Visit>
  static void for_each_bit(std::uint32_t bits, Visit&& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
  template <class Visit>
  void within(std::uint32_t level, std::uint32_t a, Visit& visit) const;
  template <class Visit>
  void within_row(std::uint32_t a, Visit& visit) const;
  template <class Visit>
  void between(std::uint32_t level, std::uint32_t a, std::uint32_t b, Visit& visit) const;
  template <class Visit>
  void between_rows(std::uint32_t a, std::uint32_t b, Visit& visit) const;
  // The parts of block a of a level that meet block b.
  [[nodiscard]] std::uint32_t parts_meeting(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
    return levels_[level][a].meeting(levels_[level + 1][b / kParts], b % kParts);
  }

  std::span<const LabelRow> labels_;
  std::vector<std::vector<Block>> levels_;  // the lowest first
};

template <class Real>
template <class Visit>
void BoxPairs<Real>::within(std::uint32_t level, std::uint32_t a, Visit& visit) const {
  if (level == 0) return within_row(a, visit);
  const Block& block = levels_[level][a];
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const std::uint32_t met = block.meeting(block, i) >> i;
    if ((met & 1) != 0) within(level - 1, kParts * a + i, visit);
    for_each_bit(met >> 1, [&](std::uint32_t k) {
      const std::uint32_t first = kParts * a + i;
      between(level - 1, first, first + k + 1, visit);
    });
  }
}

// As a rule nearly all boxes share one label: only pairs with the others are examined.
template <class Real>
template <class Visit>
void BoxPairs<Real>::within_row(std::uint32_t a, Visit& visit) const {
  const Block& block = levels_[0][a];
  const LabelRow& labels = labels_[a];
  const std::uint32_t done = labels.sharing_one();
  for_each_bit(~done & ((1U << kParts) - 1), [&](std::uint32_t i) {
    const std::uint32_t met = block.meeting(block, i) & ~labels.sharing(labels, i);
    for_each_bit(met & (done | (~0U << i << 1)), [&](std::uint32_t j) { visit(kParts * a + i, kParts * a + j); });
  });
}

template <class Real>
template <class Visit>
void BoxPairs<Real>::between(std::uint32_t level, std::uint32_t a, std::uint32_t b, Visit& visit) const {
  if (level == 0) return between_rows(a, b, visit);
  // The parts of one block that meet the other block; then the parts of the other that meet these.
  const Block &of_a = levels_[level][a], &of_b = levels_[level][b];
  for_each_bit(parts_meeting(level, a, b), [&](std::uint32_t i) {
    for_each_bit(of_b.meeting(of_a, i),
                 [&](std::uint32_t j) { between(level - 1, kParts * a + i, kParts * b + j, visit); });
  });
}

template <class Real>
template <class Visit>
void BoxPairs<Real>::between_rows(std::uint32_t a, std::uint32_t b, Visit& visit) const {
  const Block &of_a = levels_[0][a], &of_b = levels_[0][b];
  const LabelRow &labels_of_a = labels_[a], &labels_of_b = labels_[b];
  for_each_bit(parts_meeting(0, a, b), [&](std::uint32_t i) {
    const std::uint32_t met = of_b.meeting(of_a, i);
    if (met == 0) return;
    for_each_bit(met & ~labels_of_b.sharing(labels_of_a, i),
                 [&](std::uint32_t j) { visit(kParts * a + i, kParts * b + j); });
  });
}

}  // namespace deliso
