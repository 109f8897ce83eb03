#include "surface/recover/violation_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
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

// The power of two and the block that one comes with; one for all multiple hits.
std::array<int, 4> group_of(const Pushed& pushed, double key) {
  if (pushed.violation.kind == ViolationKind::kMultiIntersect) return {};
  const auto coordinate = [](double x) { return static_cast<int>(std::clamp(x / 32, 0.0, 255.0)); };
  const int octave = key == 0 ? -1000 : std::isinf(key) ? 1000 : std::ilogb(static_cast<float>(key));
  return {octave, coordinate(pushed.where.x), coordinate(pushed.where.y), coordinate(pushed.where.z)};
}

TEST(ViolationQueue, KindsComeInThePapersOrderThenPowersOfTwoThenBlocksAndTheWorstOfABlockFirst) {
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kLargestRadius}) {
    const auto key = [&](const Pushed& p) { return order == QueueOrder::kWorstFirst ? p.badness : p.radius; };
    const std::vector<Pushed> popped = all_in_order_of_pops(order, random_violations(1));
    std::set<std::array<int, 4>> left;  // groups that have been left
    for (std::size_t i = 1; i < popped.size(); ++i) {
      const Pushed& a = popped[i - 1];
      const Pushed& b = popped[i];
      ASSERT_LE(a.violation.kind, b.violation.kind);
      if (a.violation.kind != b.violation.kind) continue;
      const auto group_a = group_of(a, key(a));
      const auto group_b = group_of(b, key(b));
      if (a.violation.kind == ViolationKind::kExtractManifold) {
        ASSERT_LT(a.violation.element, b.violation.element);  // by age
      } else if (group_a != group_b) {
        ASSERT_GE(group_a[0], group_b[0]);
        left.insert(group_a);
        ASSERT_EQ(left.count(group_b), 0u);
      } else {
        ASSERT_GE(key(a), key(b) * (1 - 1e-6));
      }
    }
    EXPECT_GT(left.size(), 20u);
  }
}

// Violations that pass through other queues come out in the same order as without.
TEST(ViolationQueue, WhatIsHandedOutAndPutBackKeepsItsPlace) {
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kFirstInFirstOut, QueueOrder::kLargestRadius}) {
    const std::vector<Pushed> list = random_violations(4);
    ViolationQueue queue(order);
    std::array<ViolationQueue, 2> others = {ViolationQueue(order), ViolationQueue(order)};
    const std::size_t half = list.size() / 2;
    for (const Pushed& p : std::span(list).first(half)) queue.push(p.violation, p.badness, p.radius, p.where);
    const std::vector<Violation> all = queue.take_all();
    EXPECT_EQ(all.size(), half);
    EXPECT_EQ(queue.size(), 0u);
    EXPECT_FALSE(queue.pop());
    for (std::size_t i = 0; i < all.size(); ++i) others[i % 2].put_back(all[i]);
    for (ViolationQueue& other : others) {
      for (int i = 0; i < 10; ++i) queue.put_back(*other.pop());
      for (const Violation& violation : other.take_all()) queue.put_back(violation);
    }
    for (const Pushed& p : std::span(list).subspan(half)) queue.push(p.violation, p.badness, p.radius, p.where);
    for (const Pushed& expected : all_in_order_of_pops(order, list)) {
      const auto violation = queue.pop();
      ASSERT_TRUE(violation);
      ASSERT_EQ(violation->element, expected.violation.element);
    }
    EXPECT_FALSE(queue.pop());
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
