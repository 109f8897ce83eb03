// The violations that stage 1 still has to look at, in the order it takes them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/parameters.h"

namespace deliso {

// The paper's three steps, in the order of their priority.
enum class ViolationKind : std::uint8_t { kMultiIntersect, kExtractManifold, kApproximateGeometry };

struct Violation {
  ViolationKind kind = ViolationKind::kMultiIntersect;
  std::uint32_t element = 0;     // a dual edge or, for kExtractManifold, a vertex
  std::uint32_t generation = 0;  // of the dual edge when it was queued
};

// The worst or the largest first. ApproximateGeom, which makes most of the insertions, takes those of one power of two
// block by block of 32 voxels' side, in the order of a space-filling curve (Morton), and within a block the worst
// first: so refinement goes on from coarse to fine everywhere, and insertions that follow each other find their
// surroundings in the caches. Umbrellas, which are only good or bad, come first in, first out; so does everything in
// the order of that name.
class ViolationQueue {
 public:
  explicit ViolationQueue(QueueOrder order) : order_(order) {}

  // `badness`: how far beyond its threshold; `radius`: size of the facet: the order decides which of them counts.
  // `where`: a point nearby, in mesh space.
  void push(const Violation& violation, double badness, double radius, const Vec3& where) {
    std::vector<Entry>& entries = entries_[static_cast<std::size_t>(violation.kind)];
    ++size_;
    if (is_by_age(violation.kind)) {
      entries.push_back({0, violation.element, violation.generation});
      return;
    }
    // Of a float's bits the exponent comes before the block, all of them after it.
    std::uint64_t rank = bits_of(order_ == QueueOrder::kWorstFirst ? badness : radius);
    if (violation.kind == ViolationKind::kApproximateGeometry) {
      rank |= ((rank >> 23) << 56) | (std::uint64_t{block_of(where)} << 32);
    }
    entries.push_back({rank, violation.element, violation.generation});
    std::push_heap(entries.begin(), entries.end());
  }

  std::optional<Violation> pop() {
    for (const ViolationKind kind :
         {ViolationKind::kMultiIntersect, ViolationKind::kExtractManifold, ViolationKind::kApproximateGeometry}) {
      const auto i = static_cast<std::size_t>(kind);
      if (entries_[i].empty()) continue;
      --size_;
      const Entry entry = is_by_age(kind) ? pop_oldest(entries_[i], first_[i]) : pop_greatest(entries_[i]);
      return Violation{kind, entry.element, entry.generation};
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

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

  [[nodiscard]] bool is_by_age(ViolationKind kind) const {
    return order_ == QueueOrder::kFirstInFirstOut || kind == ViolationKind::kExtractManifold;
  }
  // The bits of a float that is not negative, which compare as it does.
  static std::uint32_t bits_of(double key) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return std::bit_cast<std::uint32_t>(static_cast<float>(std::min(std::max(key, 0.0), kMost)));
  }
  // Eight bits of every coordinate, interleaved; what lies beyond counts with the outermost block.
  static std::uint32_t block_of(const Vec3& where) {
    constexpr double kSide = 32;
    constexpr double kLast = 255;
    std::uint32_t block = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto c = static_cast<std::uint32_t>(std::min(std::max(where[axis] / kSide, 0.0), kLast));
      for (std::size_t bit = 0; bit < 8; ++bit) block |= ((c >> bit) & 1u) << (3 * bit + axis);
    }
    return block;
  }
  static Entry pop_greatest(std::vector<Entry>& heap) {
    std::pop_heap(heap.begin(), heap.end());
    const Entry entry = heap.back();
    heap.pop_back();
    return entry;
  }
  static Entry pop_oldest(std::vector<Entry>& queue, std::size_t& first) {
    const Entry entry = queue[first++];
    if (2 * first >= queue.size()) {
      queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(first));
      first = 0;
    }
    return entry;
  }

  QueueOrder order_;
  std::array<std::vector<Entry>, 3> entries_;  // of each kind: a heap, or a queue that begins at first_
  std::array<std::size_t, 3> first_{};
  std::size_t size_ = 0;
};

}  // namespace deliso
