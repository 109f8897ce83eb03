// Triangles measured side by side: each must get what it gets alone, by the plain formulas.
#include "surface/refine/triangle_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "delaunay/base/rng.h"
#include "delaunay/constructions.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// By the criteria of criteria.h, one triangle after the other.
void expect_measured_alone(const TriangleLanes& lanes, const Criteria& limits, int trial) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const TriangleMeasures sigma = {std::abs(lanes.height[i]), lanes.radius[i], lanes.shortest[i], lanes.mean_pole[i]};
    ASSERT_EQ(bits(lanes.badness[i]), bits(refine_geometry_badness(sigma, limits))) << trial;
    const Vec3 x = lanes.dual.origin.at(i) + lanes.height[i] * lanes.dual.direction.at(i);
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(bits(lanes.x.at(i)[axis]), bits(x[axis])) << trial;
    ASSERT_EQ(bits(lanes.squared_radius[i]), bits(squared_distance(x, lanes.a.at(i)))) << trial;
  }
}

Criteria random_limits(Rng& rng) {
  Criteria limits{.epsilon = rng.uniform(0.05, 1), .rho = rng.uniform(1, 3), .epsilon2 = rng.uniform(0.05, 1)};
  if (rng.below(2) == 0) limits.max_distance = rng.uniform(0.1, 1);
  if (rng.below(4) == 0) limits.epsilon2 = kInfinity;
  if (rng.below(2) == 0) limits.criterion2 = Criterion2::kShortestEdge;
  return limits;
}

TEST(TriangleLanes, BallsAndBadnessAreThoseOfTheCriteriaBitForBit) {
  Rng rng(2);
  std::array<int, 4> worst{};  // how often each ratio is the largest
  for (int trial = 0; trial < 20000; ++trial) {
    TriangleLanes lanes;
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes.a.set(i, random_point(rng));
      lanes.b.set(i, random_point(rng));
      lanes.c.set(i, random_point(rng));
      lanes.mean_pole[i] = rng.uniform(0.1, 80);
    }
    measure_in_planes(lanes);
    for (std::size_t i = 0; i < kLanes; ++i) lanes.height[i] = rng.uniform(-3, 3);
    const Criteria limits = random_limits(rng);
    measure_balls(lanes, limits);
    expect_measured_alone(lanes, limits, trial);
    const TriangleMeasures sigma = {std::abs(lanes.height[0]), lanes.radius[0], lanes.shortest[0], lanes.mean_pole[0]};
    const std::array<double, 4> ratios = {badness1(sigma, limits), badness2(sigma, limits), badness3(sigma, limits),
                                          distance_badness(sigma, limits)};
    const auto largest = std::max_element(ratios.begin(), ratios.end());
    ASSERT_EQ(lanes.badness[0], *largest) << trial;
    ++worst[static_cast<std::size_t>(largest - ratios.begin())];
  }
  for (const int count : worst) EXPECT_GT(count, 500);
}

// Triangles without area, dual lines without a hit, poles at the vertices: zeros, infinities, what is not a number.
TEST(TriangleLanes, DegenerateMeasuresGiveTheSameBadnessToo) {
  const std::array<double, 5> values = {0, 1.5, 1e-300, kInfinity, std::nan("")};
  Rng rng(3);
  const auto any = [&] { return values[rng.below(values.size())]; };
  for (int trial = 0; trial < 5000; ++trial) {
    TriangleLanes lanes;
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes.height[i] = any();
      lanes.radius[i] = any();
      lanes.shortest[i] = any();
      lanes.mean_pole[i] = any();
    }
    const Criteria limits = random_limits(rng);
    measure_balls(lanes, limits);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const TriangleMeasures sigma = {lanes.height[i], lanes.radius[i], lanes.shortest[i], lanes.mean_pole[i]};
      const double expected = refine_geometry_badness(sigma, limits);
      ASSERT_EQ(std::isnan(lanes.badness[i]), std::isnan(expected)) << trial;
      if (!std::isnan(expected)) {
        ASSERT_EQ(bits(lanes.badness[i]), bits(expected)) << trial;
      }
    }
  }
}

}  // namespace
}  // namespace deliso
