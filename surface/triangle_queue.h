// The triangles that stage 2 still has to refine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "surface/parameters.h"

namespace deliso {

struct QueuedTriangle {
  std::uint32_t triangle = 0;
  std::uint32_t generation = 0;  // of the triangle's slot when it was queued
};

// Worst or largest first, or first in first out; ties by age.
class TriangleQueue {
 public:
  explicit TriangleQueue(QueueOrder order) : order_(order) {}

  void push(const QueuedTriangle& triangle, double badness, double radius) {
    if (order_ == QueueOrder::kFirstInFirstOut) {
      fifo_.push(triangle);
    } else {
      const double key = order_ == QueueOrder::kWorstFirst ? badness : radius;
      heap_.push({static_cast<float>(key), next_age_++, triangle});
    }
  }
  std::optional<QueuedTriangle> pop() {
    if (size() == 0) return std::nullopt;
    QueuedTriangle top;
    if (order_ == QueueOrder::kFirstInFirstOut) {
      top = fifo_.front();
      fifo_.pop();
    } else {
      top = heap_.top().triangle;
      heap_.pop();
    }
    return top;
  }
  [[nodiscard]] std::size_t size() const { return fifo_.size() + heap_.size(); }

 private:
  struct Entry {
    float key;
    std::uint32_t age;
    QueuedTriangle triangle;
    // std::priority_queue pops the largest.
    bool operator<(const Entry& b) const { return key != b.key ? key < b.key : age > b.age; }
  };
  QueueOrder order_;
  std::uint32_t next_age_ = 0;
  std::queue<QueuedTriangle> fifo_;
  std::priority_queue<Entry> heap_;
};

}  // namespace deliso
