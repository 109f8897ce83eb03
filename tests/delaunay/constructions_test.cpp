#include "delaunay/constructions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "delaunay/base/rng.h"
#include "delaunay/circumcenter_pairs.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

Vec3 random_point(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }

TEST(Circumcenter, IsEquallyFarFromAllFourVertices) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a = random_point(rng);
    Vec3 b = random_point(rng);
    Vec3 c = random_point(rng);
    const Vec3 d = random_point(rng);
    if (orient3d(a, b, c, d) < 0) std::swap(b, c);
    const Vec3 center = circumcenter(a, b, c, d);
    const double radius = distance(center, a);
    if (radius > 100) continue;  // too flat to ask for digits
    for (const Vec3& p : {b, c, d}) ASSERT_NEAR(distance(center, p), radius, 1e-9 * radius * radius) << "case " << i;
  }
}

TEST(Circumcenter, IsExactForACornerOfACube) {
  EXPECT_EQ(circumcenter({3, 4, 5}, {5, 4, 5}, {3, 6, 5}, {3, 4, 7}), (Vec3{4, 5, 6}));
}

// Four points within rounding of one plane (but not of one circle): whatever the rounding of the constructed point, it
// is finite, far off, and on the side where an exact computation has it.
TEST(Circumcenter, OfANearlyFlatTetrahedronIsFiniteAndOnTheCorrectSide) {
  Rng rng(2);
  int flat = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a{0, 0, 0.5};
    Vec3 b{1, 0, 0.5};
    Vec3 c{0, 1, 0.5};
    Vec3 d{rng.uniform(), rng.uniform(), 0.5};
    const double in_circle = d.x + d.y - squared_norm(Vec3{d.x, d.y, 0});  // positive inside the circle abc
    if (std::abs(in_circle) < 1e-3) continue;
    for (auto steps = 1 + rng.below(4); steps > 0; --steps) d.z = std::nextafter(d.z, i % 2 == 0 ? 1.0 : 0.0);
    // d a little above the plane and inside the circle: the ball through d has its center far below, and so on.
    const bool above = (d.z > 0.5) != (in_circle > 0);
    if (orient3d(a, b, c, d) < 0) std::swap(b, c);
    const Vec3 center = circumcenter(a, b, c, d);
    ++flat;
    ASSERT_TRUE(is_finite(center)) << "case " << i;
    ASSERT_EQ(center.z > 0.5, above) << "case " << i;
    ASSERT_GT(std::abs(center.z), 1e10) << "case " << i;
  }
  EXPECT_GT(flat, 5000);
}

TEST(Circumcenter, IsFiniteForTheFlattestTetrahedronThereIs) {
  const Vec3 center = circumcenter({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0x1p-160});
  EXPECT_TRUE(is_finite(center));
  EXPECT_LT(center.z, -1e40);
}

LiftedRow lifted(const Vec3& p) { return {Pair{p.x, p.y}, Pair{p.z, squared_norm(p)}}; }

// Round tetrahedra, slivers, flat ones and tiny ones, two at a time.
TEST(Circumcenter, OfAPairIsThatOfEachBitForBitOrUncertain) {
  Rng rng(5);
  int certain = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a = random_point(rng);
    std::array<std::array<Vec3, 3>, 2> others;
    for (auto& [b, c, d] : others) {
      const double size = std::exp2(-static_cast<double>(rng.below(4) == 0 ? rng.below(300) : 0));
      for (Vec3* const p : {&b, &c, &d}) *p = a + size * random_point(rng);
      if (rng.below(4) == 0) d = a + 0.3 * (b - a) + rng.uniform() * (c - a) + 1e-9 * rng.uniform() * random_point(rng);
      if (orient3d(a, b, c, d) < 0) std::swap(b, c);
    }
    const auto rows = [&](std::size_t k) { return RowPair(lifted(others[0][k] - a), lifted(others[1][k] - a)); };
    const CircumcenterPair pair = circumcenter_pair(a, rows(0), rows(1), rows(2));
    for (unsigned k = 0; k < 2; ++k) {
      if (!pair.is_certain[k]) continue;
      const auto& [b, c, d] = others[k];
      ASSERT_EQ(pair.centers.at(k), circumcenter(a, b, c, d)) << "case " << i;
      ++certain;
    }
  }
  EXPECT_GT(certain, 12000);
  EXPECT_LT(certain, 20000);
}

TEST(Circumcircle, LiesInThePlaneAndIsEquallyFarFromAllThreeVertices) {
  Rng rng(3);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a = random_point(rng);
    const Vec3 b = random_point(rng);
    const Vec3 c = random_point(rng);
    const Circumcircle circle = circumcircle(a, b, c);
    if (circle.radius > 100) continue;
    const double tolerance = 1e-11 * circle.radius * circle.radius;
    for (const Vec3& p : {a, b, c}) ASSERT_NEAR(distance(circle.center, p), circle.radius, tolerance) << "case " << i;
    const Vec3 normal = cross(b - a, c - a);
    ASSERT_NEAR(dot(circle.center - a, normal) / norm(normal), 0, tolerance) << "case " << i;
  }
}

TEST(Circumcircle, IsTheSameBitByBitForEveryOrderOfTheVertices) {
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random_point(rng);
    const Vec3 b = random_point(rng);
    const Vec3 c = random_point(rng);
    const Circumcircle circle = circumcircle(a, b, c);
    const Circumcircle orders[] = {circumcircle(b, c, a), circumcircle(c, a, b), circumcircle(b, a, c),
                                   circumcircle(a, c, b), circumcircle(c, b, a)};
    for (const Circumcircle& other : orders) {
      ASSERT_EQ(other.center, circle.center) << "case " << i;
      ASSERT_EQ(other.radius, circle.radius) << "case " << i;
    }
  }
}

TEST(Circumcircle, OfADegenerateTriangleIsInfinite) {
  const Circumcircle line = circumcircle({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  EXPECT_TRUE(std::isinf(line.radius));
  EXPECT_EQ(line.center, (Vec3{2, 2, 2}));
  const Circumcircle point = circumcircle({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
  EXPECT_TRUE(std::isinf(point.radius));
  EXPECT_EQ(point.center, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace deliso
