#include "volume/marching_cubes/loop_band.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Costs = std::vector<std::vector<double>>;

// The sum of the chords of a band, its first one counted at both ends; infinite when a chord comes twice.
double cost_of(const Costs& chord, std::size_t start, unsigned along_second) {
  const std::size_t n = chord.size(), m = chord[0].size();
  std::set<std::pair<std::size_t, std::size_t>> used;
  double cost = chord[0][start];
  for (std::size_t i = 0, j = 0; i + j < n + m;) {
    ++((along_second >> (i + j) & 1u) != 0 ? j : i);
    if (!used.insert({i % n, (start + j) % m}).second) return kInfinity;
    cost += chord[i % n][(start + j) % m];
  }
  return cost;
}

TEST(LoopBand, IsTheCheapestOfAllFromItsStart) {
  int none = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    const std::size_t n = 3 + rng.below(4), m = 3 + rng.below(3);
    Costs chord(n, std::vector<double>(m));
    for (auto& row : chord) {
      // Distinct sums of powers of two would not fit; small integers make ties, which must not matter.
      for (double& c : row) c = rng.below(5) == 0 ? kInfinity : static_cast<double>(rng.below(20));
    }
    std::vector<double> best(m, kInfinity);
    for (unsigned word = 0; word < 1u << (n + m); word += 2) {
      if (std::popcount(word) != static_cast<int>(m)) continue;
      for (std::size_t start = 0; start < m; ++start) best[start] = std::min(best[start], cost_of(chord, start, word));
    }
    const auto bands = loop_bands(n, m, [&](std::size_t i, std::size_t j) { return chord[i][j]; });
    std::vector<double> found(m, kInfinity);
    double last = 0;
    for (const LoopBand& band : bands) {
      EXPECT_EQ(std::popcount(band.along_second), static_cast<int>(m)) << "seed " << seed;
      EXPECT_EQ(band.along_second & 1u, 0u) << "seed " << seed;
      EXPECT_EQ(cost_of(chord, band.start, band.along_second), band.cost) << "seed " << seed;
      EXPECT_LE(last, band.cost) << "seed " << seed;
      last = band.cost;
      found[band.start] = band.cost;
    }
    ASSERT_EQ(found, best) << "seed " << seed;
    none += bands.empty() ? 1 : 0;
  }
  EXPECT_GT(none, 0);
  EXPECT_LT(none, 200);
}

}  // namespace
}  // namespace deliso
