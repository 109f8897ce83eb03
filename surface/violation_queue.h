// The violations that stage 1 still has to look at, in the order it takes them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "surface/parameters.h"

namespace deliso {

// The paper's three steps, in the order of their priority.
enum class ViolationKind : std::uint8_t { kMultiIntersect, kExtractManifold, kApproximateGeometry };

struct Violation {
  ViolationKind kind = ViolationKind::kMultiIntersect;
  std::uint32_t element = 0;     // a dual edge or, for kExtractManifold, a vertex
  std::uint32_t generation = 0;  // of the dual edge when it was queued
};

// For each kind a row of stacks, one for every power of two of the badness (or of the radius, as the order says). The
// worst stack comes first, and of that the latest entry: it lies near the latest insertions, which the caches still
// hold. Umbrellas, which are only good or bad, come first in, first out; so does everything in the order of that name.
class ViolationQueue {
 public:
  explicit ViolationQueue(QueueOrder order) : order_(order) {}

  // `badness`: how far beyond its threshold; `radius`: size of the facet. The order decides which of them counts.
  void push(const Violation& violation, double badness, double radius) {
    Stacks& stacks = stacks_[static_cast<std::size_t>(violation.kind)];
    const std::size_t place =
        is_by_age(violation.kind) ? 0 : place_of(order_ == QueueOrder::kWorstFirst ? badness : radius);
    stacks.entries[place].push_back({violation.element, violation.generation});
    stacks.used |= std::uint64_t{1} << place;
    ++size_;
  }

  std::optional<Violation> pop() {
    for (std::size_t kind = 0; kind < stacks_.size(); ++kind) {
      if (stacks_[kind].used == 0) continue;
      --size_;
      const Entry entry =
          is_by_age(static_cast<ViolationKind>(kind)) ? pop_first(stacks_[kind]) : pop_last(stacks_[kind]);
      return Violation{static_cast<ViolationKind>(kind), entry.element, entry.generation};
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Entry {
    std::uint32_t element;
    std::uint32_t generation;
  };
  static constexpr int kPlaces = 64;
  static constexpr int kMiddle = 32;  // place of keys from 1/2 to 1
  struct Stacks {
    std::array<std::vector<Entry>, kPlaces> entries;
    std::uint64_t used = 0;  // bit i: entries[i] is not empty
    std::size_t first = 0;   // entries[0] begins here when it is a queue
  };

  [[nodiscard]] bool is_by_age(ViolationKind kind) const {
    return order_ == QueueOrder::kFirstInFirstOut || kind == ViolationKind::kExtractManifold;
  }
  static std::size_t place_of(double key) {
    if (!(key > 0)) return 0;
    if (!(key < 0x1p31)) return kPlaces - 1;
    int exponent = 0;
    std::frexp(key, &exponent);
    return static_cast<std::size_t>(std::clamp(exponent + kMiddle, 0, kPlaces - 1));
  }
  static Entry pop_last(Stacks& stacks) {
    const auto place = static_cast<std::size_t>(std::bit_width(stacks.used)) - 1;
    std::vector<Entry>& stack = stacks.entries[place];
    const Entry entry = stack.back();
    stack.pop_back();
    if (stack.empty()) stacks.used ^= std::uint64_t{1} << place;
    return entry;
  }
  static Entry pop_first(Stacks& stacks) {
    std::vector<Entry>& queue = stacks.entries[0];
    const Entry entry = queue[stacks.first++];
    if (2 * stacks.first >= queue.size()) {
      queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(stacks.first));
      stacks.first = 0;
    }
    if (queue.empty()) stacks.used = 0;
    return entry;
  }

  QueueOrder order_;
  std::array<Stacks, 3> stacks_;
  std::size_t size_ = 0;
};

}  // namespace deliso
