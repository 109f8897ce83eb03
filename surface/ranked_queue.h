// What is left to refine, in both stages: elements of a mesh by rank.
//
// Worst or largest first; of those of one power of two block by block of 32 voxels' side, in the order of a
// space-filling curve (Morton), and within a block the worst first: so refinement goes on from coarse to fine
// everywhere, and insertions that follow each other find their surroundings in the caches.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Ranks by a number that is not negative: its bits as a float, which compare as it does.
inline std::uint64_t plain_rank(double key) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return std::bit_cast<std::uint32_t>(static_cast<float>(std::min(std::max(0.0, key), kMost)));
}

// Ranks by the number's power of two, then by the block of a point in mesh space, then by the number: of a float's bits
// the exponent comes before the block, all of them after it.
inline std::uint64_t block_rank(double key, const Vec3& where) {
  // Eight bits of every coordinate, interleaved; what lies beyond counts with the outermost block.
  constexpr double kSide = 32;
  constexpr double kLast = 255;
  std::uint64_t block = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint32_t c = static_cast<std::uint32_t>(std::min(std::max(0.0, where[axis] / kSide), kLast));
    c = (c | c << 8) & 0x0F00Fu;
    c = (c | c << 4) & 0xC30C3u;
    c = (c | c << 2) & 0x249249u;
    block |= std::uint64_t{c} << axis;
  }
  const std::uint64_t bits = plain_rank(key);
  return ((bits >> 23) << 56) | (block << 32) | bits;
}

// An element and its generation when it was queued, which tells whether it is still what it was.
struct QueuedElement {
  std::uint32_t element = 0;
  std::uint32_t generation = 0;
};

// Highest rank first; or first in, first out.
class RankedQueue {
 public:
  void push(std::uint64_t rank, const QueuedElement& queued) {
    entries_.push_back({rank, queued.element, queued.generation});
    std::push_heap(entries_.begin(), entries_.end());
  }
  void push_by_age(const QueuedElement& queued) { push(--next_age_, queued); }

  std::optional<QueuedElement> pop() {
    if (entries_.empty()) return std::nullopt;
    std::pop_heap(entries_.begin(), entries_.end());
    const Entry top = entries_.back();
    entries_.pop_back();
    return QueuedElement{top.element, top.generation};
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint64_t rank;
    std::uint32_t element;
    std::uint32_t generation;
    // The standard heap pops the greatest. A total order, so that every library pops the same.
    bool operator<(const Entry& b) const {
      if (rank != b.rank) return rank < b.rank;
      return element != b.element ? element > b.element : generation < b.generation;
    }
  };

  std::vector<Entry> entries_;  // a heap
  std::uint64_t next_age_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace deliso
