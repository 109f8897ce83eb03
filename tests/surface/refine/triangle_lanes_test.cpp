// Triangles measured side by side: each must get what it gets alone, by the plain formulas.
#include "surface/refine/triangle_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "delaunay/base/rng.h"
#include "delaunay/constructions.h"

namespace deliso {
namespace {

Vec3 random_point(Rng& rng) { return {rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9)}; }

TEST(TriangleLanes, PlanesAreMeasuredAsOneByOne) {
  Rng rng(1);
  for (int trial = 0; trial < 2000; ++trial) {
    TriangleLanes lanes;
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes.a.set(i, random_point(rng));
      lanes.b.set(i, random_point(rng));
      // At times a needle, or an isosceles triangle.
      const Vec3 a = lanes.a.at(i), b = lanes.b.at(i), shift{b.y - a.y, a.x - b.x, 0};
      lanes.c.set(i, trial % 3 == 0   ? a + 1e-6 * random_point(rng)
                     : trial % 3 == 1 ? 0.5 * (a + b) + shift
                                      : random_point(rng));
    }
    measure_in_planes(lanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3 a = lanes.a.at(i), b = lanes.b.at(i), c = lanes.c.at(i);
      const Circumcircle circle = circumcircle(a, b, c);
      const Vec3 normal = cross(b - a, c - a);
      const std::array<double, 3> edges = {squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)};
      ASSERT_EQ(lanes.radius[i], circle.radius) << trial;
      ASSERT_EQ(lanes.dual.origin.at(i), circle.center) << trial;
      ASSERT_EQ(lanes.dual.direction.at(i), normal / norm(normal)) << trial;
      ASSERT_EQ(lanes.shortest[i], std::sqrt(*std::min_element(edges.begin(), edges.end()))) << trial;
      ASSERT_EQ(lanes.squared_longest[i], *std::max_element(edges.begin(), edges.end())) << trial;
    }
  }
}

TEST(TriangleLanes, TrianglesWithoutAreaHaveNoFiniteRadius) {
  TriangleLanes lanes;  // all corners at one point
  lanes.b.set(1, {1, 2, 3});
  lanes.c.set(1, {2, 4, 6});
  lanes.b.set(2, {0, 0, 0});
  lanes.c.set(2, {1, 1, 1});
  lanes.b.set(3, {1, 0, 0});
  lanes.c.set(3, {0, 1, 0});
  measure_in_planes(lanes);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(std::isfinite(lanes.radius[i])) << i;
  EXPECT_EQ(lanes.radius[3], std::sqrt(0.5));
  EXPECT_EQ(lanes.dual.direction.at(3), (Vec3{0, 0, 1}));
}

TEST(TriangleLanes, BadnessIsTheLargestRatio) {
  Rng rng(2);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 2000; ++trial) {
    TriangleLanes lanes;
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes.a.set(i, random_point(rng));
      lanes.b.set(i, random_point(rng));
      lanes.c.set(i, random_point(rng));
      lanes.mean_pole[i] = rng.uniform(0.1, 40);
    }
    measure_in_planes(lanes);
    for (std::size_t i = 0; i < kLanes; ++i) lanes.height[i] = rng.uniform(-1, 1);
    const BadnessLimits limits = {0.1, 0.2, 2, trial % 2 == 0 ? 0.5 : kInfinity, trial % 4 < 2};
    measure_balls(lanes, limits);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double h = std::abs(lanes.height[i]), r = lanes.radius[i], l = lanes.shortest[i];
      const double size = limits.by_shortest_edge ? l : r;
      const double worst = std::max({h / (r * limits.epsilon1), size / (lanes.mean_pole[i] * limits.epsilon2),
                                     r / (l * limits.rho), h / limits.max_distance});
      ASSERT_EQ(lanes.badness[i], worst) << trial;
      const Vec3 x = lanes.dual.origin.at(i) + lanes.height[i] * lanes.dual.direction.at(i);
      ASSERT_EQ(lanes.x.at(i), x) << trial;
      ASSERT_EQ(lanes.squared_radius[i], squared_distance(x, lanes.a.at(i))) << trial;
    }
  }
}

}  // namespace
}  // namespace deliso
