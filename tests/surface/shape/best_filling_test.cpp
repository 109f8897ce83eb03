// The filling of a polygon whose worst triangle is best, against all triangulations.
#include "surface/shape/best_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {
namespace {

// The best of all triangulations of the corners i to j, by recursion without a memory.
double best_of_all(const std::vector<Vec3>& polygon, std::size_t i, std::size_t j) {
  if (j < i + 2) return 1;
  double best = 0;
  for (std::size_t k = i + 1; k < j; ++k) {
    best = std::max(best, std::min({best_of_all(polygon, i, k), best_of_all(polygon, k, j),
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

TEST(BestFilling, FillsPolygonsWithoutArea) {
  const std::vector<Vec3> polygon(6, Vec3{1, 2, 3});
  const BestFilling filling(polygon);
  EXPECT_EQ(filling.quality(), 0);
  EXPECT_EQ(filling.triangles().size(), 4u);
}

}  // namespace
}  // namespace deliso
