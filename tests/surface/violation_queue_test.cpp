#include "surface/violation_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

struct Pushed {
  Violation violation;
  double badness = 0;
  double radius = 0;
};

// Random violations of all kinds; element i is the i-th pushed.
std::vector<Pushed> random_violations(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Pushed> list;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const auto kind = static_cast<ViolationKind>(rng.below(3));
    list.push_back({{kind, i, 7 * i}, std::exp(rng.uniform(-40, 40)), std::exp(rng.uniform(-3, 3))});
  }
  list[100].badness = list[100].radius = INFINITY;
  list[200].badness = list[200].radius = 0;
  return list;
}

std::vector<Pushed> all_in_order_of_pops(QueueOrder order, const std::vector<Pushed>& list) {
  ViolationQueue queue(order);
  for (const Pushed& p : list) queue.push(p.violation, p.badness, p.radius);
  EXPECT_EQ(queue.size(), list.size());
  std::vector<Pushed> popped;
  while (const auto violation = queue.pop()) {
    const Pushed& p = list[violation->element];
    EXPECT_EQ(violation->kind, p.violation.kind);
    EXPECT_EQ(violation->generation, p.violation.generation);
    popped.push_back(p);
  }
  EXPECT_EQ(popped.size(), list.size());
  EXPECT_EQ(queue.size(), 0u);
  return popped;
}

TEST(ViolationQueue, KindsComeInThePapersOrderAndTheWorstOfAKindFirstUpToAFactorOfTwo) {
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kLargestRadius}) {
    const std::vector<Pushed> popped = all_in_order_of_pops(order, random_violations(1));
    for (std::size_t i = 1; i < popped.size(); ++i) {
      const Pushed& a = popped[i - 1];
      const Pushed& b = popped[i];
      ASSERT_LE(a.violation.kind, b.violation.kind);
      if (a.violation.kind != b.violation.kind) continue;
      if (a.violation.kind == ViolationKind::kExtractManifold) {
        ASSERT_LT(a.violation.element, b.violation.element);  // by age
        continue;
      }
      const double worse = order == QueueOrder::kWorstFirst ? a.badness : a.radius;
      const double better = order == QueueOrder::kWorstFirst ? b.badness : b.radius;
      // Beyond 2^-32 and 2^31 all count the same.
      if (better < 0x1p31 && worse > 0x1p-32) {
        ASSERT_GT(2 * worse, better) << i;
      }
    }
  }
}

TEST(ViolationQueue, OfEquallyBadOnesTheLatestComesFirst) {
  ViolationQueue queue(QueueOrder::kWorstFirst);
  for (std::uint32_t i = 0; i < 5; ++i) queue.push({ViolationKind::kApproximateGeometry, i, 0}, 1.0 + 0.1 * i, 1);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(queue.pop()->element, 4 - i);
  EXPECT_FALSE(queue.pop());
}

TEST(ViolationQueue, FirstInFirstOutKeepsTheOrderOfEachKindWhilePushesAndPopsMix) {
  const std::vector<Pushed> list = random_violations(2);
  ViolationQueue queue(QueueOrder::kFirstInFirstOut);
  Rng rng(3);
  std::size_t pushed = 0;
  std::size_t popped = 0;
  std::array<std::int64_t, 3> last = {-1, -1, -1};
  while (popped < list.size()) {
    if (pushed < list.size() && rng.below(3) != 0) {
      const Pushed& p = list[pushed++];
      queue.push(p.violation, p.badness, p.radius);
    } else if (const auto violation = queue.pop()) {
      ++popped;
      auto& before = last[static_cast<std::size_t>(violation->kind)];
      ASSERT_LT(before, static_cast<std::int64_t>(violation->element));
      before = violation->element;
    }
    ASSERT_EQ(queue.size(), pushed - popped);
  }
}

}  // namespace
}  // namespace deliso
