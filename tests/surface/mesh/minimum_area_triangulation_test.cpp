#include "surface/mesh/minimum_area_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "delaunay/base/rng.h"
#include "delaunay/base/vec3.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Polygon {
  std::vector<Vec3> corners;
  std::set<std::pair<std::size_t, std::size_t>> taken;  // diagonals that will not do

  [[nodiscard]] double area(std::size_t i, std::size_t k, std::size_t j) const {
    return 0.5 * norm(cross(corners[k] - corners[i], corners[j] - corners[i]));
  }
  [[nodiscard]] bool is_free(std::size_t i, std::size_t j) const { return !taken.contains({i, j}); }
};

// The least area of all triangulations of a part of the polygon: one ear after another is cut off, in every way.
double least_area(const Polygon& polygon, const std::vector<std::size_t>& corners) {
  if (corners.size() == 3) return polygon.area(corners[0], corners[1], corners[2]);
  double least = kInfinity;
  for (std::size_t ear = 0; ear < corners.size(); ++ear) {
    const std::size_t before = corners[(ear + corners.size() - 1) % corners.size()];
    const std::size_t after = corners[(ear + 1) % corners.size()];
    if (!polygon.is_free(std::min(before, after), std::max(before, after))) continue;
    std::vector<std::size_t> rest = corners;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    least = std::min(least, polygon.area(before, corners[ear], after) + least_area(polygon, rest));
  }
  return least;
}

TEST(MinimumAreaTriangulation, HasTheLeastAreaOfAll) {
  Rng rng(5);
  int with = 0, without = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Polygon polygon;
    const auto n = static_cast<std::size_t>(3 + trial % 5);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < n; ++i) {
      all.push_back(i);
      polygon.corners.push_back({rng.uniform(), rng.uniform(), rng.uniform()});
      for (std::size_t j = 0; j < i; ++j) {
        if (rng.uniform() < 0.3) polygon.taken.insert({j, i});
      }
    }
    for (std::size_t i = 0; i < n; ++i) polygon.taken.erase(std::minmax(i, (i + 1) % n));
    const MinimumAreaTriangulation least(
        n, [&](std::size_t i, std::size_t k, std::size_t j) { return polygon.area(i, k, j); },
        [&](std::size_t i, std::size_t j) { return polygon.is_free(i, j); });
    const double expected = least_area(polygon, all);
    ASSERT_EQ(least.exists(), expected < kInfinity) << trial;
    (least.exists() ? with : without) += 1;
    if (!least.exists()) continue;
    EXPECT_NEAR(least.area(), expected, 1e-12) << trial;

    // Its triangles make up that area and use every side once and every diagonal from both sides.
    double area = 0;
    std::multiset<std::pair<std::size_t, std::size_t>> edges;
    for (const auto& [i, k, j] : least.triangles()) {
      EXPECT_TRUE(i < k && k < j);
      area += polygon.area(i, k, j);
      edges.insert({{i, k}, {k, j}, {i, j}});
    }
    EXPECT_NEAR(area, expected, 1e-12) << trial;
    EXPECT_EQ(edges.size(), 3 * (n - 2));
    for (const auto& edge : edges) {
      const bool is_side = edge.second - edge.first == 1 || edge.second - edge.first == n - 1;
      EXPECT_EQ(edges.count(edge), is_side ? 1u : 2u) << trial;
      EXPECT_TRUE(polygon.is_free(edge.first, edge.second)) << trial;
    }
  }
  EXPECT_GT(with, 50);
  EXPECT_GT(without, 10);
}

TEST(MinimumAreaTriangulation, TakesNoTriangleOfInfiniteCost) {
  const auto never = [](std::size_t, std::size_t, std::size_t) { return kInfinity; };
  const auto always = [](std::size_t, std::size_t) { return true; };
  EXPECT_FALSE(MinimumAreaTriangulation(3, never, always).exists());
  EXPECT_FALSE(MinimumAreaTriangulation(6, never, always).exists());
  const auto fan_of_two = [](std::size_t i, std::size_t k, std::size_t j) {
    return i == 2 || k == 2 || j == 2 ? 1.0 : kInfinity;
  };
  const MinimumAreaTriangulation fan(6, fan_of_two, always);
  ASSERT_TRUE(fan.exists());
  for (const auto& t : fan.triangles()) EXPECT_NE(std::find(t.begin(), t.end(), 2u), t.end());
}

}  // namespace
}  // namespace deliso
