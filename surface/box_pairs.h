// Pairs of boxes that may meet, among many.
//
// The boxes stand in the order of halving (surface/halving_order.h): eight in a row make a block, eight blocks one of
// the next level, up to a single one. A block holds the boxes of its eight parts side by side, so that a box is
// compared with all of them at once; only blocks of the same level are compared.
//
// In floats this takes half as long as in doubles. Rounding to floats keeps the order of numbers, so boxes that have a
// point in common still have one; but those that are apart by less than the rounding, some 2^-24 of the whole, seem to
// have one, too: where many boxes are smaller than that, only doubles tell them apart.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

template <class Real>
class BoxPairs {
 public:
  // Of `count` boxes; box_of(i) gives the box at place i, none has a point below `low`.
  template <class BoxOf>
  BoxPairs(std::size_t count, const Vec3& low, BoxOf&& box_of) {
    if (count == 0) return;
    levels_.emplace_back((count + kParts - 1) / kParts);
    for (std::size_t i = 0; i < count; ++i) levels_[0][i / kParts].set(i % kParts, rounded(box_of(i), low));
    enclose();
  }

  // Pairs that can be looked for apart from all others.
  struct Task {
    std::uint32_t level = 0, a = 0, b = 0;  // blocks; the same for pairs within one
  };
  [[nodiscard]] std::vector<Task> tasks() const;

  // Calls visit(i, j) once for each pair of places of the task whose boxes have a point in common, faces included, and
  // in floats for others that are apart by less than the rounding.
  template <class Visit>
  void for_each(const Task& task, Visit&& visit) const {
    task.a == task.b ? within(task.level, task.a, visit) : between(task.level, task.a, task.b, visit);
  }

 private:
  static constexpr std::uint32_t kParts = 8;
  static constexpr std::size_t kTaskBlocks = 64;  // tasks begin at a level of at least so many blocks

  struct Bounds {
    std::array<Real, 3> low{}, high{};
  };
  // The boxes of eight parts, coordinate by coordinate; what there is none of is empty.
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
    [[nodiscard]] Bounds part(std::size_t i) const {
      return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
    }
    [[nodiscard]] Bounds bounds() const;
    // Bit i: whether part i and b have a point in common.
    [[nodiscard]] std::uint32_t meeting(const Bounds& b) const {
      // Masks instead of truth values, so that compilers take several parts at once.
      constexpr std::array<std::uint32_t, kParts> kBit = {1, 2, 4, 8, 16, 32, 64, 128};
      const auto mask = [](bool condition) { return condition ? ~0U : 0U; };
      std::array<std::uint32_t, kParts> found;
      for (std::size_t i = 0; i < kParts; ++i) {
        const std::uint32_t x = mask(low[0][i] <= b.high[0]) & mask(b.low[0] <= high[0][i]);
        const std::uint32_t y = mask(low[1][i] <= b.high[1]) & mask(b.low[1] <= high[1][i]);
        const std::uint32_t z = mask(low[2][i] <= b.high[2]) & mask(b.low[2] <= high[2][i]);
        found[i] = x & y & z & kBit[i];
      }
      std::uint32_t bits = 0;
      for (const std::uint32_t bit : found) bits |= bit;
      return bits;
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
  void between(std::uint32_t level, std::uint32_t a, std::uint32_t b, Visit& visit) const;

  std::vector<std::vector<Block>> levels_;  // the lowest first
};

template <class Real>
template <class Visit>
void BoxPairs<Real>::within(std::uint32_t level, std::uint32_t a, Visit& visit) const {
  const Block& block = levels_[level][a];
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const std::uint32_t met = block.meeting(block.part(i)) >> i;
    if ((met & 1) != 0 && level > 0) within(level - 1, kParts * a + i, visit);
    for_each_bit(met >> 1, [&](std::uint32_t k) {
      const std::uint32_t first = kParts * a + i, second = first + k + 1;
      level == 0 ? visit(first, second) : between(level - 1, first, second, visit);
    });
  }
}

template <class Real>
template <class Visit>
void BoxPairs<Real>::between(std::uint32_t level, std::uint32_t a, std::uint32_t b, Visit& visit) const {
  // Of the one block the parts that meet the other block, of the other the parts that meet these.
  const Block &of_a = levels_[level][a], &of_b = levels_[level][b];
  for_each_bit(of_a.meeting(levels_[level + 1][b / kParts].part(b % kParts)), [&](std::uint32_t i) {
    for_each_bit(of_b.meeting(of_a.part(i)), [&](std::uint32_t j) {
      const std::uint32_t first = kParts * a + i, second = kParts * b + j;
      level == 0 ? visit(first, second) : between(level - 1, first, second, visit);
    });
  });
}

}  // namespace deliso
