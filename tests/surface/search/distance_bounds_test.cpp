#include "surface/search/distance_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_distance.h"

namespace deliso {
namespace {

Vec3 random_step(Rng& rng) { return {2 * rng.uniform() - 1, 2 * rng.uniform() - 1, 2 * rng.uniform() - 1}; }

// Of any shape, and any size from small to huge: some thin, some without an area.
std::array<Vec3, 3> random_triangle(Rng& rng, const Vec3& near) {
  const double size = std::pow(10, 4 * rng.uniform() - 1),
               thin = rng.uniform() < 0.5 ? 1 : std::pow(10, -9 * rng.uniform());
  const Vec3 along = size * random_step(rng), across = size * thin * random_step(rng);
  const double place = rng.uniform();
  const Vec3 at = near + 2 * random_step(rng) - 0.3 * along - 0.3 * across;
  if (rng.uniform() < 0.05) return {at, at + along, at + along};
  return {at, at + along, at + place * along + across};
}

TEST(DistanceBounds, HoldTheDistanceOfTheNearestTriangle) {
  int within = 0, beyond = 0, unknown = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Rng rng(seed);
    const Vec3 middle = 200 * random_step(rng);
    std::vector<Vec3> points(1 + rng.below(DistanceBounds::kMostPoints));
    for (Vec3& p : points) p = middle + 8 * random_step(rng);
    DistanceBounds bounds(points, middle);
    std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
    for (std::uint64_t count = rng.below(4); count > 0; --count) {
      const auto [a, b, c] = random_triangle(rng, points[rng.below(points.size())]);
      bounds.add(TrianglePlanes(a, b, c, middle));
      for (std::size_t i = 0; i < points.size(); ++i) {
        nearest[i] = std::min(nearest[i], std::sqrt(squared_distance_to_triangle(points[i], a, b, c)));
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double asked : {0.5, 0.8, 3.0, nearest[i]}) {
        if (!(asked < 100)) continue;
        const bool is_within = bounds.is_within(i, asked), is_beyond = bounds.is_beyond(i, asked);
        EXPECT_TRUE(!is_within || nearest[i] < asked) << "seed " << seed;
        EXPECT_TRUE(!is_beyond || nearest[i] > asked) << "seed " << seed;
        if (asked == nearest[i]) continue;
        within += is_within ? 1 : 0;
        beyond += is_beyond ? 1 : 0;
        unknown += is_within || is_beyond ? 0 : 1;
      }
    }
  }
  EXPECT_GT(within, 3000);
  EXPECT_GT(beyond, 30000);
  EXPECT_LT(unknown, (within + beyond) / 2);
}

// Open is what lies beyond a side, a little nearer than is asked.
TEST(DistanceBounds, TellOfMostPointsBesideGoodTriangles) {
  const double height = std::sqrt(0.75);
  const TrianglePlanes planes({0, 0, 0}, {4, 0, 0}, {2, 4 * height, 0}, {2, 1, 0});
  int open = 0, all = 0;
  for (double x = -2; x <= 6; x += 0.125) {
    for (double y = -2; y <= 5; y += 0.125) {
      const std::vector<Vec3> points = {{x, y, 0.2}, {x, y, -0.6}};
      DistanceBounds bounds(points, {2, 1, 0});
      bounds.add(planes);
      for (std::size_t i = 0; i < points.size(); ++i) {
        ++all;
        open += bounds.is_within(i, 0.8) || bounds.is_beyond(i, 0.8) ? 0 : 1;
      }
    }
  }
  EXPECT_LT(open, all / 8);
}

TEST(DistanceBounds, WithoutTrianglesEverythingIsFar) {
  const std::vector<Vec3> points = {{1, 2, 3}};
  const DistanceBounds bounds(points, {1, 2, 4});
  EXPECT_TRUE(bounds.is_beyond(0, 99));
  EXPECT_FALSE(bounds.is_within(0, 99));
}

}  // namespace
}  // namespace deliso
