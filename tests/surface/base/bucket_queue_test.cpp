#include "surface/base/bucket_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

// Ranks as both stages use them: by blocks, plain, and some that agree in one half.
std::uint64_t random_rank(Rng& rng) {
  const double key = std::ldexp(rng.uniform(1, 2), static_cast<int>(rng.below(6)) - 3);
  switch (rng.below(4)) {
    case 0:
      return plain_rank(key);
    case 1:
      return std::uint64_t{rng.below(4)} << 32 | rng.below(3);
    default:
      return block_rank(key, {rng.uniform(0, 200), rng.uniform(0, 200), rng.uniform(0, 200)});
  }
}

// Against a set in the order that the queue promises: rank down, then element up, then generation down.
TEST(BucketQueue, PopsByRankHoweverPushesAndPopsMix) {
  using Key = std::tuple<std::uint64_t, std::int64_t, std::uint32_t>;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    BucketQueue queue;
    std::set<Key> expected;
    int foretold = 0;
    for (int step = 0; step < 4000; ++step) {
      if (rng.below(5) < (step < 2000 ? 3U : 2U)) {
        const std::uint64_t rank = random_rank(rng);
        const auto element = static_cast<std::uint32_t>(rng.below(50));
        const auto generation = static_cast<std::uint32_t>(rng.below(1000000));
        if (!expected.insert({rank, -std::int64_t{element}, generation}).second) continue;
        queue.push(rank, {element, generation});
      } else {
        const auto next = queue.next();
        const auto popped = queue.pop();
        ASSERT_EQ(popped.has_value(), !expected.empty()) << "seed " << seed << " step " << step;
        if (!popped) continue;
        const auto last = std::prev(expected.end());
        ASSERT_EQ(popped->queued.element, -std::get<1>(*last)) << "seed " << seed << " step " << step;
        ASSERT_EQ(popped->queued.generation, std::get<2>(*last)) << "seed " << seed << " step " << step;
        if (next) {
          ASSERT_EQ(*next, popped->queued.element);
          ++foretold;
        }
        expected.erase(last);
      }
      ASSERT_EQ(queue.size(), expected.size());
    }
    EXPECT_GT(foretold, 100) << "seed " << seed;
  }
}

TEST(BucketQueue, ByAgeTheFirstComesOutFirst) {
  BucketQueue queue;
  for (std::uint32_t i = 0; i < 100; ++i) queue.push_by_age({i, 2 * i});
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(queue.pop()->queued.element, i);
  EXPECT_FALSE(queue.pop());
}

}  // namespace
}  // namespace deliso
