// The filling of a polygon whose worst triangle is best, against all triangulations.
#include "surface/shape/best_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {
namespace {

using Diagonals = std::set<std::pair<std::size_t, std::size_t>>;

// The best of all triangulations of the corners i to j, by recursion without a memory.
double best_of_all(const std::vector<Vec3>& polygon, std::size_t i, std::size_t j, const Diagonals& taken = {}) {
  if (j < i + 2) return 1;
  if (taken.contains({i, j})) return 0;
  double best = 0;
  for (std::size_t k = i + 1; k < j; ++k) {
    best = std::max(best, std::min({best_of_all(polygon, i, k, taken), best_of_all(polygon, k, j, taken),
                                    sine_of_least_angle(polygon[i], polygon[k], polygon[j])}));
  }
  return best;
}

TEST(BestFilling, IsTheBestOfAllTriangulations) {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> polygon(3 + rng.below(6));
    for (Vec3& p : polygon) p = {rng.uniform(), rng.uniform(), rng.uniform()};
    const BestFilling filling(polygon);
    EXPECT_EQ(filling.quality(), best_of_all(polygon, 0, polygon.size() - 1)) << "trial " << trial;
    double least = 1;
    for (const auto& [i, j, k] : filling.triangles()) {
      EXPECT_TRUE(i < j && j < k);
      least = std::min(least, sine_of_least_angle(polygon[i], polygon[j], polygon[k]));
    }
    EXPECT_EQ(least, filling.quality());
    EXPECT_EQ(filling.triangles().size(), polygon.size() - 2);
  }
}

TEST(BestFilling, IsTheBestOfThoseWithFreeDiagonals) {
  Rng rng(2);
  int impossible = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> polygon(4 + rng.below(5));
    for (Vec3& p : polygon) p = {rng.uniform(), rng.uniform(), rng.uniform()};
    Diagonals taken;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      for (std::size_t j = i + 2; j < polygon.size(); ++j) {
        const bool is_diagonal = i > 0 || j + 1 < polygon.size();
        if (is_diagonal && rng.below(3) == 0) taken.insert({i, j});
      }
    }
    const BestFilling filling(polygon, [&](std::size_t i, std::size_t j) { return !taken.contains({i, j}); });
    EXPECT_EQ(filling.quality(), best_of_all(polygon, 0, polygon.size() - 1, taken)) << "trial " << trial;
    impossible += filling.quality() == 0 ? 1 : 0;
    if (filling.quality() == 0) continue;
    for (const auto& [i, j, k] : filling.triangles()) {
      EXPECT_FALSE(taken.contains({i, j}) || taken.contains({j, k}) || taken.contains({i, k})) << "trial " << trial;
    }
  }
  EXPECT_GT(impossible, 0);
  EXPECT_LT(impossible, 150);
}

TEST(BestFilling, FillsPolygonsWithoutArea) {
  const std::vector<Vec3> polygon(6, Vec3{1, 2, 3});
  const BestFilling filling(polygon);
  EXPECT_EQ(filling.quality(), 0);
  EXPECT_EQ(filling.triangles().size(), 4u);
}

}  // namespace
}  // namespace deliso
