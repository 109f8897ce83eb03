// Edit distances of known and random words, and the nearest of some names.
#include "delaunay/base/nearest_name.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(EditDistance, KnownPairs) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("spehre", "sphere"), 1u);  // one swap of neighbours
  EXPECT_EQ(edit_distance("rho", "rho"), 0u);
  EXPECT_EQ(edit_distance("CA", "ABC"), 3u);  // optimal string alignment: no edit inside a swapped pair
}

TEST(EditDistance, IsAMetricUpToSwapsOnRandomWords) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Rng rng(seed);
    const auto word = [&rng] {
      std::string w;
      for (std::uint64_t n = rng.below(7); n > 0; --n) w += static_cast<char>('a' + rng.below(3));
      return w;
    };
    const std::string a = word();
    const std::string b = word();
    const std::size_t d = edit_distance(a, b);
    EXPECT_EQ(d, edit_distance(b, a)) << "seed " << seed;
    EXPECT_EQ(d == 0, a == b) << "seed " << seed;
    EXPECT_LE(d, std::max(a.size(), b.size())) << "seed " << seed;
    EXPECT_GE(d + std::min(a.size(), b.size()), std::max(a.size(), b.size())) << "seed " << seed;
    const auto between = [](const std::string& w) { return std::string("xx").append(w).append("y"); };
    EXPECT_EQ(d, edit_distance(between(a), between(b))) << "seed " << seed;
  }
}

TEST(EditDistance, OneEditGivesOne) {
  const std::string word = "spacing";
  for (std::size_t n = 0; n < word.size(); ++n) {
    std::string erased = word;
    erased.erase(n, 1);
    EXPECT_EQ(edit_distance(word, erased), 1u);
    std::string replaced = word;
    replaced[n] = '#';
    EXPECT_EQ(edit_distance(word, replaced), 1u);
    std::string inserted = word;
    inserted.insert(n, 1, '#');
    EXPECT_EQ(edit_distance(word, inserted), 1u);
    std::string swapped = word;
    if (n + 1 < word.size()) {
      std::swap(swapped[n], swapped[n + 1]);
      EXPECT_EQ(edit_distance(word, swapped), 1u);
    }
  }
}

TEST(NearestName, IsTheNearestAndTheFirstOfEquals) {
  const std::vector<std::string> known{"epsilon", "rho", "r_min", "seed"};
  EXPECT_EQ(nearest_name("epsilom", known), "epsilon");
  EXPECT_EQ(nearest_name("rmin", known), "r_min");
  EXPECT_EQ(nearest_name("", known), "rho");
  EXPECT_EQ(nearest_name("x", {"a", "b"}), "a");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name_hint("x", {}), "");
  EXPECT_NE(nearest_name_hint("rmin", known).find("\"r_min\""), std::string::npos);
}

}  // namespace
}  // namespace deliso
