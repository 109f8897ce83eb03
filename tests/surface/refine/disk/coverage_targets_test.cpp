// Coverage targets that a mesh has missed, and their insertion in stage 2.
#include "surface/refine/disk/coverage_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/base/parallel_blocks.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/verification/surface_distance.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/refine_runs.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::Scene;

double distance_to(const RefinementMesh& mesh, std::uint32_t t, const Vec3& p) {
  return std::sqrt(squared_distance_to_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
}

// How far off a triangle a coverage target may be to count as near.
double reach_of(const RefinementMesh& mesh, std::uint32_t t, double least) {
  const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
  const double edge = std::max({distance(a, b), distance(b, c), distance(c, a)});
  if (edge <= 4) return std::max(0.8, least);
  const Vec3 n = cross(b - a, c - a);
  return std::max({0.8, least, std::min(edge, 2 * std::abs(dot(n / norm(n), mesh.triangles[t].ball.center - a)))});
}

TEST(CoverageTargets, MissedAreThoseThatNoTriangleIsNear) {
  Rng rng(5);
  for (const double size : {1.0, 8.0}) {
    SurfaceMesh soup;
    for (std::uint32_t t = 0; t < 40; ++t) {
      const Vec3 at{20 * rng.uniform(), 20 * rng.uniform(), 20 * rng.uniform()};
      for (int i = 0; i < 3; ++i) {
        soup.points.push_back(at + size * Vec3{rng.uniform(), rng.uniform(), rng.uniform()});
      }
      soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      soup.neighbours.push_back({kNoSide, kNoSide, kNoSide});
      soup.pole_heights.resize(soup.points.size(), 1);
    }
    const std::size_t count = soup.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {  // each triangle twice, so that the first of equals must be reported
      soup.triangles.push_back(std::array{soup.triangles[t]});
      soup.neighbours.push_back({kNoSide, kNoSide, kNoSide});
    }
    RefinementMesh mesh(soup);
    for (RefinementMesh::Triangle& t : mesh.triangles) {
      const std::array<Vec3, 3> corners = mesh.corner_points(t.corners);
      t.ball.center = corners[0] + Vec3{(size > 4 ? 10 : 2) * rng.uniform(), 0, 0};
      if (rng.uniform() < 0.5) continue;
      for (const Vec3& p : corners)
        t.ball.squared_radius = std::max(t.ball.squared_radius, squared_distance(p, t.ball.center));
    }
    const BallOf ball_of = [&](std::uint32_t t) { return mesh.triangles[t].ball; };
    std::vector<Vec3> coverage_targets(1000);
    for (Vec3& p : coverage_targets) p = {40 * rng.uniform() - 10, 30 * rng.uniform() - 5, 20 * rng.uniform()};
    for (const double least : {0.1, 1.5}) {
      const std::vector<MissedTarget> missed = missed_targets(coverage_targets, mesh, ball_of, least, 1);
      std::size_t expected = 0;
      for (const Vec3& p : coverage_targets) {
        double nearest = std::numeric_limits<double>::infinity();
        bool is_near = false;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
          nearest = std::min(nearest, distance_to(mesh, t, p));
          is_near = is_near || distance_to(mesh, t, p) <= reach_of(mesh, t, least);
        }
        if (is_near || nearest >= 6) continue;
        ++expected;
        const auto at = std::find_if(missed.begin(), missed.end(), [&](const MissedTarget& m) { return m.point == p; });
        ASSERT_NE(at, missed.end());
        EXPECT_NEAR(std::sqrt(at->squared_distance), nearest, 1e-12);
        EXPECT_NEAR(distance_to(mesh, at->triangle, p), nearest, 1e-12);
        EXPECT_LT(at->triangle, count);
      }
      EXPECT_EQ(missed.size(), expected);
      EXPECT_GT(expected, 40u);
      EXPECT_TRUE(std::is_sorted(missed.begin(), missed.end(), [](const MissedTarget& m, const MissedTarget& n) {
        return m.squared_distance > n.squared_distance;
      }));
      // Asked about a few, fewer than triangles, it leaves out most triangles early; the answers are the same.
      std::size_t among_few = 0;
      for (std::size_t first = 0; first < coverage_targets.size(); first += 10) {
        const auto few = std::span<const Vec3>(coverage_targets).subspan(first, 10);
        for (const MissedTarget& m : missed_targets(few, mesh, ball_of, least, 1)) {
          const auto at =
              std::find_if(missed.begin(), missed.end(), [&](const MissedTarget& n) { return n.point == m.point; });
          ASSERT_NE(at, missed.end());
          EXPECT_EQ(m.triangle, at->triangle);
          EXPECT_EQ(m.squared_distance, at->squared_distance);
          ++among_few;
        }
      }
      EXPECT_EQ(among_few, missed.size());
    }
  }
}

TEST(CoverageTargets, MissedAreTheSameForAnyNumberOfThreads) {
  Rng rng(6);
  SurfaceMesh soup;
  for (std::uint32_t t = 0; t < 3 * kBlockSize; ++t) {
    const Vec3 at{40 * rng.uniform(), 40 * rng.uniform(), 40 * rng.uniform()};
    for (int i = 0; i < 3; ++i) soup.points.push_back(at + Vec3{rng.uniform(), rng.uniform(), rng.uniform()});
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    soup.neighbours.push_back({kNoSide, kNoSide, kNoSide});
  }
  soup.pole_heights.resize(soup.points.size(), 1);
  const RefinementMesh mesh(soup);
  const BallOf ball_of = [&](std::uint32_t t) { return mesh.triangles[t].ball; };
  std::vector<Vec3> coverage_targets(20000);
  for (Vec3& p : coverage_targets) p = {50 * rng.uniform() - 5, 40 * rng.uniform(), 40 * rng.uniform()};
  const auto found = [&](int threads) {
    std::vector<std::tuple<double, std::uint32_t, double>> all;
    for (const MissedTarget& m : missed_targets(coverage_targets, mesh, ball_of, 0, threads)) {
      all.emplace_back(m.point.x, m.triangle, m.squared_distance);
    }
    return all;
  };
  const auto one = found(1);
  EXPECT_GT(one.size(), 1000u);
  EXPECT_LT(one.size(), 19000u);
  for (const int threads : {2, 5}) EXPECT_EQ(found(threads), one);
}

// A wall with a finger on it, one sample wide, between the corners of large triangles.
TEST(CoverageTargets, BringFingersBackThatRefinementWouldPassBy) {
  constexpr double kWall = 6.4;
  int passed_by = 0, brought_back = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const auto i = static_cast<double>(6 + rng.below(10)), j = static_cast<double>(6 + rng.below(10));
    const double height = 1.6 + rng.uniform();
    const Scene scene(
        "finger",
        testing::sampled({22, 22, 14},
                         [&](const Vec3& p) {
                           const double wall = kWall - p.z;
                           const double finger = height + wall;
                           return p.x == i && p.y == j && p.z > kWall ? std::min(std::max(wall, finger), 0.4) : wall;
                         }),
        0);
    // The wall alone, as a stage 1 leaves it that has not seen the finger.
    SurfaceMesh start;
    const double last = 21;
    start.points = {{0, 0, kWall}, {last, 0, kWall}, {last, last, kWall}, {0, last, kWall}};
    start.pole_heights.assign(4, 1000);
    start.triangles = {{0, 1, 2}, {0, 2, 3}};
    start.neighbours = {{kNoSide, 6, kNoSide}, {kNoSide, kNoSide, 1}};
    const std::vector<Vec3> crossings = testing::crossing_points(scene);
    const auto farthest = [&](const SurfaceMesh& mesh) {
      return points_to_mesh(crossings, {mesh.points, mesh.triangles}, 100).max_voxels;
    };
    RefineOptions options;
    options.r_min = 0.2;
    SurfaceMesh without = start;
    testing::run(without, scene, options);
    options.coverage_targets = crossings;
    SurfaceMesh with = start;
    const RefineStats stats = testing::run(with, scene, options);
    EXPECT_EQ(testing::surface_mesh_defect(with), "");
    EXPECT_EQ(self_intersections(TriangleMesh{with.points, with.triangles}).crossing_pairs, 0);
    if (farthest(without) <= 1) continue;
    ++passed_by;
    brought_back += farthest(with) <= 0.9 && stats.coverage_targets > 0 ? 1 : 0;
  }
  EXPECT_GT(passed_by, 5);
  EXPECT_EQ(brought_back, passed_by);
}

}  // namespace
}  // namespace deliso
