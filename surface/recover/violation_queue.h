// The violations that stage 1 still has to examine, in the order in which it takes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/base/bucket_queue.h"
#include "surface/base/parameters.h"

namespace deliso {

// The paper's three steps, in the order of their priority.
enum class ViolationKind : std::uint8_t { kMultiIntersect, kExtractManifold, kApproximateGeometry };

struct Violation {
  ViolationKind kind = ViolationKind::kMultiIntersect;
  std::uint32_t element = 0;     // a dual edge or, for kExtractManifold, a vertex
  std::uint32_t generation = 0;  // of the dual edge when it was queued
  std::uint64_t rank = 0;        // among those of its kind; set by the queue
};

// The order: the worst or the largest violation first. ApproximateGeom, which makes most of the insertions, proceeds
// block by block. Umbrellas, which are either disks or not, come first in, first out; so does everything if that order
// is chosen.
class ViolationQueue {
 public:
  explicit ViolationQueue(QueueOrder order) : order_(order) {}

  // `badness`: by how much a threshold is exceeded; `radius`: size of the facet. The order determines which of the two
  // is used. `where`: a point nearby, in mesh space.
  void push(const Violation& violation, double badness, double radius, const Vec3& where) {
    BucketQueue& queue = queues_[static_cast<std::size_t>(violation.kind)];
    const QueuedElement queued{violation.element, violation.generation};
    const double key = order_ == QueueOrder::kWorstFirst ? badness : radius;
    if (order_ == QueueOrder::kFirstInFirstOut || violation.kind == ViolationKind::kExtractManifold) {
      queue.push_by_age(queued);
    } else if (violation.kind == ViolationKind::kApproximateGeometry) {
      queue.push(block_rank(key, where), queued);
    } else {
      queue.push(plain_rank(key), queued);
    }
  }

  std::optional<Violation> pop() {
    for (const ViolationKind kind :
         {ViolationKind::kMultiIntersect, ViolationKind::kExtractManifold, ViolationKind::kApproximateGeometry}) {
      const auto popped = queues_[static_cast<std::size_t>(kind)].pop();
      if (popped) return violation(kind, *popped);
    }
    return std::nullopt;
  }
  // Puts back what pop() or take_all() gave, of this queue or another one of the same order.
  void put_back(const Violation& violation) {
    queues_[static_cast<std::size_t>(violation.kind)].put_back(
        {violation.rank, {violation.element, violation.generation}});
  }
  // Empties the queue; returns what it held, in unspecified order.
  std::vector<Violation> take_all() {
    std::vector<Violation> all;
    all.reserve(size());
    for (const ViolationKind kind :
         {ViolationKind::kMultiIntersect, ViolationKind::kExtractManifold, ViolationKind::kApproximateGeometry}) {
      queues_[static_cast<std::size_t>(kind)].take_all(
          [&](const RankedElement& element) { all.push_back(violation(kind, element)); });
    }
    return all;
  }
  [[nodiscard]] std::size_t size() const { return queues_[0].size() + queues_[1].size() + queues_[2].size(); }

 private:
  static Violation violation(ViolationKind kind, const RankedElement& element) {
    return {kind, element.queued.element, element.queued.generation, element.rank};
  }

  QueueOrder order_;
  std::array<BucketQueue, 3> queues_;  // of each kind
};

}  // namespace deliso
