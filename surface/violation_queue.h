// The violations that stage 1 still has to look at, in the order it takes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
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

// One heap for each kind: the larger badness first, or the earlier entry, as the order says; ties by age.
class ViolationQueue {
 public:
  explicit ViolationQueue(QueueOrder order) : order_(order) {}

  // `badness`: how far beyond its threshold; `radius`: size of the facet. The order decides which of them counts.
  void push(const Violation& violation, double badness, double radius) {
    const double key = order_ == QueueOrder::kWorstFirst ? badness : order_ == QueueOrder::kLargestRadius ? radius : 0;
    heaps_[static_cast<std::size_t>(violation.kind)].push({key, next_age_++, violation});
  }
  std::optional<Violation> pop() {
    for (auto& heap : heaps_) {
      if (heap.empty()) continue;
      const Violation top = heap.top().violation;
      heap.pop();
      return top;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t size() const { return heaps_[0].size() + heaps_[1].size() + heaps_[2].size(); }

 private:
  struct Entry {
    double key;
    std::uint64_t age;
    Violation violation;
    // std::priority_queue pops the largest.
    bool operator<(const Entry& b) const { return key != b.key ? key < b.key : age > b.age; }
  };
  QueueOrder order_;
  std::uint64_t next_age_ = 0;
  std::array<std::priority_queue<Entry>, 3> heaps_;
};

}  // namespace deliso
