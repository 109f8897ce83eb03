#include "surface/recover/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/base/rng.h"
#include "delaunay/constructions.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/coverage_query.h"
#include "surface/search/covering_triangles.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;

double distance_to(const SurfaceMesh& mesh, std::uint32_t t, const Vec3& p) {
  const auto& v = mesh.triangles[t];
  return std::sqrt(squared_distance_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
}

double radius_of(const SurfaceMesh& mesh, std::uint32_t t) {
  const auto& v = mesh.triangles[t];
  return circumcircle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]).radius;
}

double longest_edge_of(const SurfaceMesh& mesh, std::uint32_t t) {
  const auto& v = mesh.triangles[t];
  return std::max({distance(mesh.points[v[0]], mesh.points[v[1]]), distance(mesh.points[v[1]], mesh.points[v[2]]),
                   distance(mesh.points[v[2]], mesh.points[v[0]])});
}

// Triangles of many sizes, and sides that lead anywhere: answers do not depend on them.
SurfaceMesh soup(Rng& rng) {
  SurfaceMesh mesh;
  for (std::uint32_t t = 0; t < 60; ++t) {
    const double size = 0.2 * std::pow(20, rng.uniform());
    const Vec3 at{20 * rng.uniform(), 20 * rng.uniform(), 20 * rng.uniform()};
    for (int i = 0; i < 3; ++i) {
      mesh.points.push_back(at + size * Vec3{rng.uniform(), rng.uniform(), rng.uniform()});
    }
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    mesh.neighbours.push_back({4 * ((7 * t + 1) % 60), kNoSide, 4 * ((t + 59) % 60)});
  }
  return mesh;
}

TEST(Coverage, AgreesWithMeasuringEveryTriangle) {
  Rng rng(9);
  const SurfaceMesh mesh = soup(rng);
  std::vector<Vec3> points(2000);
  for (Vec3& p : points) p = {20 * rng.uniform(), 20 * rng.uniform(), 20 * rng.uniform()};
  const CoverageQuery cover(mesh);
  std::uint32_t guess = 0;
  const auto takes = [](std::uint32_t t) { return t % 3 != 0; };
  const std::vector<std::uint32_t> few = covering_triangles(points, mesh, takes);
  EXPECT_EQ(covering_triangles(points, mesh, takes, 3), few);
  int covered = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    std::uint32_t by_some = kNoTriangle;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double d = distance_to(mesh, t, points[i]);
      if (d < nearest) triangle = t;
      nearest = std::min(nearest, d);
      const bool is_covered = d <= 0.65;
      EXPECT_EQ(is_covered_by(points[i], mesh, t), is_covered);
      if (is_covered && takes(t) && by_some == kNoTriangle) by_some = t;
    }
    const bool expected =
        nearest < 0.8 || nearest <= 0.3 * std::min(radius_of(mesh, triangle), longest_edge_of(mesh, triangle));
    EXPECT_EQ(cover.covers(points[i], guess), expected);
    EXPECT_EQ(few[i], by_some);
    covered += expected ? 1 : 0;
  }
  EXPECT_GT(covered, 50);
  EXPECT_LT(covered, 1950);

  // A few points have most triangles far from all of them.
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const std::vector<Vec3> some(points.begin() + static_cast<std::ptrdiff_t>(i),
                                 points.begin() + static_cast<std::ptrdiff_t>(std::min(i + 1 + i % 2, points.size())));
    const std::vector<std::uint32_t> answers = covering_triangles(some, mesh, takes);
    for (std::size_t j = 0; j < some.size(); ++j) EXPECT_EQ(answers[j], few[i + j]);
  }
}

// A triangle is left out early by its first corner only when it is too small to reach a point from there.
TEST(Coverage, ATriangleReachesAPointFarFromItsFirstCorner) {
  const Vec3 p{10, 10, 10};
  const auto any = [](std::uint32_t) { return true; };
  for (double far = 0.5; far < 16; far += 0.25) {
    for (const double side : {-1.0, 1.0}) {
      SurfaceMesh mesh;
      mesh.points = {p + side * Vec3{far, 0, 0}, p + side * Vec3{0.3, 0, 0}, p + side * Vec3{0.3, 0.5, 0}};
      mesh.triangles = {{0, 1, 2}};
      mesh.neighbours = {{kNoSide, kNoSide, kNoSide}};
      // Another point, for the point to lie anywhere in its block.
      for (double other = 0; other < 8; other += 0.3) {
        EXPECT_EQ(covering_triangles({p, p - Vec3{other, 0, 0}}, mesh, any)[0], 0u) << far << " " << side;
      }
    }
  }
}

// Stage 1 as it stands at its start: most crossings are not covered.
TEST(Coverage, FindsTheSameForAnyNumberOfThreads) {
  const auto scene = field_scene("gyroid", 64);
  const RestrictedDelaunay restricted(*scene->isosurface, scene->start());
  const auto found = [&](int threads) {
    std::vector<std::uint32_t> suspects = all_crossings(scene->surface(threads));
    std::vector<Vec3> points = uncovered_points(restricted, scene->surface(threads), suspects);
    return std::pair(suspects, points);
  };
  ASSERT_GT(scene->topology.crossings.size(), 2 * kBlockSize);
  const auto one = found(1);
  EXPECT_GT(one.first.size(), 100u);
  EXPECT_EQ(one.second.size(), one.first.size());
  for (const int threads : {2, 3, 5}) EXPECT_EQ(found(threads), one) << threads;
}

TEST(Coverage, OrdersAllCrossings) {
  const auto scene = field_scene("bubbles", 24);
  std::vector<std::uint32_t> crossings = all_crossings(scene->surface());
  for (const int threads : {2, 3, 5}) EXPECT_EQ(all_crossings(scene->surface(threads)), crossings);
  // Bricks of 8 samples in order, and within each the crossings in theirs.
  const auto key = [&](std::uint32_t crossing) {
    const Vec3 p = crossing_position(scene->grid, scene->topology.crossings[crossing]);
    return std::array{std::floor(p.z / 8), std::floor(p.y / 8), std::floor(p.x / 8), static_cast<double>(crossing)};
  };
  EXPECT_TRUE(std::is_sorted(crossings.begin(), crossings.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); }));
  std::sort(crossings.begin(), crossings.end());
  ASSERT_EQ(crossings.size(), scene->topology.crossings.size());
  for (std::uint32_t i = 0; i < crossings.size(); ++i) EXPECT_EQ(crossings[i], i);
}

}  // namespace
}  // namespace deliso
