// Disjoint sets against labels that every union repaints.
#include "delaunay/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(DisjointSets, RandomUnionsMatchRepaintedLabels) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    const auto count = static_cast<std::uint32_t>(1 + rng.below(40));
    std::vector<std::uint32_t> label(count);  // the smallest member of each number's set
    for (std::uint32_t i = 0; i < count; ++i) label[i] = i;
    DisjointSets sets(count);
    for (std::uint64_t n = rng.below(2 * count); n > 0; --n) {
      const auto i = static_cast<std::uint32_t>(rng.below(count)), j = static_cast<std::uint32_t>(rng.below(count));
      const std::uint32_t low = std::min(label[i], label[j]), high = std::max(label[i], label[j]);
      if (n % 2 == 0) {
        EXPECT_EQ(sets.unite(i, j), low != high) << "seed " << seed;
      } else {
        EXPECT_EQ(sets.unite_representative(sets.find(i), j), low) << "seed " << seed;
      }
      for (std::uint32_t& other : label) other = other == high ? low : other;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      EXPECT_EQ(sets.find(i), label[i]) << "seed " << seed;
      EXPECT_TRUE(label[i] == label[0] || !sets.share_parent(i, 0)) << "seed " << seed;
    }
  }
}

TEST(DisjointSets, ResetLeavesEachNumberAlone) {
  DisjointSets sets(3);
  sets.unite(0, 2);
  sets.reset(5);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(sets.find(i), i);
}

}  // namespace
}  // namespace deliso
