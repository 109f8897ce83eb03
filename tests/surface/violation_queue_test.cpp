#include "surface/violation_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

struct Pushed {
  Violation violation;
  double badness = 0;
  double radius = 0;
  Vec3 where;
};

// Random violations of all kinds; element i is the i-th pushed.
std::vector<Pushed> random_violations(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Pushed> list;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const auto kind = static_cast<ViolationKind>(rng.below(3));
    const auto coordinate = [&] { return rng.uniform(-20, 90); };
    list.push_back({{kind, i, 7 * i},
                    std::exp(rng.uniform(-40, 40)),
                    std::exp(rng.uniform(-3, 3)),
                    {coordinate(), coordinate(), coordinate()}});
  }
  list[100].badness = list[100].radius = INFINITY;
  list[200].badness = list[200].radius = 0;
  list[300].where = {-INFINITY, INFINITY, 1e300};
  return list;
}

std::vector<Pushed> all_in_order_of_pops(QueueOrder order, const std::vector<Pushed>& list) {
  ViolationQueue queue(order);
  for (const Pushed& p : list) queue.push(p.violation, p.badness, p.radius, p.where);
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

// One for all multiple hits.
std::array<int, 3> block_of(const Pushed& pushed) {
  if (pushed.violation.kind == ViolationKind::kMultiIntersect) return {};
  const Vec3& p = pushed.where;
  const auto coordinate = [](double x) { return static_cast<int>(std::clamp(x / 32, 0.0, 255.0)); };
  return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
}

TEST(ViolationQueue, KindsComeInThePapersOrderThenBlocksAfterEachOtherAndTheWorstOfABlockFirst) {
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kLargestRadius}) {
    const std::vector<Pushed> popped = all_in_order_of_pops(order, random_violations(1));
    std::set<std::pair<ViolationKind, std::array<int, 3>>> left;  // blocks that have been left
    for (std::size_t i = 1; i < popped.size(); ++i) {
      const Pushed& a = popped[i - 1];
      const Pushed& b = popped[i];
      ASSERT_LE(a.violation.kind, b.violation.kind);
      if (a.violation.kind != b.violation.kind) continue;
      if (a.violation.kind == ViolationKind::kExtractManifold) {
        ASSERT_LT(a.violation.element, b.violation.element);  // by age
      } else if (block_of(a) != block_of(b)) {
        left.emplace(a.violation.kind, block_of(a));
        ASSERT_EQ(left.count({b.violation.kind, block_of(b)}), 0u);
      } else {
        const double worse = order == QueueOrder::kWorstFirst ? a.badness : a.radius;
        const double better = order == QueueOrder::kWorstFirst ? b.badness : b.radius;
        ASSERT_GE(worse, better * (1 - 1e-6));
      }
    }
    EXPECT_GT(left.size(), 10u);
  }
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
      queue.push(p.violation, p.badness, p.radius, p.where);
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
