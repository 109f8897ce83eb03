// The guard of stage 2 against testing every triangle of the mesh.
#include "surface/refine/guard/crossing_guard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "delaunay/base/rng.h"
#include "delaunay/triangle_contact.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/refine/guard/clearances.h"

namespace deliso {
namespace {

// Two wavy sheets of n x n squares, `gap` apart, cut into triangles.
SurfaceMesh two_sheets(std::uint32_t n, double gap, Rng& rng) {
  SurfaceMesh mesh;
  for (int sheet = 0; sheet < 2; ++sheet) {
    const auto base = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        mesh.points.push_back(
            {i + 0.3 * rng.uniform(), j + 0.3 * rng.uniform(), sheet * gap + 0.2 * gap * rng.uniform()});
        mesh.pole_heights.push_back(gap / 2);
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t at = base + j * (n + 1) + i;
        mesh.triangles.push_back({at, at + 1, at + n + 2});
        mesh.triangles.push_back({at, at + n + 2, at + n + 1});
      }
    }
  }
  mesh.neighbours.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  return mesh;
}

Vec3 centroid_of(const SurfaceMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
}

// What the guard says of splitting one triangle at p.
bool guard_crosses(RefinementDisk& disk, CrossingGuard& guard, const Vec3& p, double moved, std::uint32_t seed) {
  const RefinementCandidate candidate{.point = p, .ball_radius = 1, .seed = seed};
  disk.grow(candidate, [](std::uint32_t) { return SurfaceDelaunayBall{}; });
  EXPECT_EQ(disk.order_rim(candidate), RefinementDisk::Shape::kDisk);
  return guard.crosses(p, {0, 0, 1}, moved, disk);
}

bool crosses_by_brute_force(SurfaceMesh mesh, const Vec3& p, std::uint32_t seed) {
  const auto newest = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(p);
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  triangles.erase(triangles.begin() + seed);
  const std::size_t old = triangles.size();
  for (unsigned i = 0; i < 3; ++i) {
    triangles.push_back({newest, mesh.triangles[seed][i], mesh.triangles[seed][(i + 1) % 3]});
  }
  for (std::size_t s = old; s < triangles.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      if (triangle_contact(mesh.points, triangles[s], triangles[t]) != TriangleContact::kNone) return true;
    }
  }
  return false;
}

TEST(CrossingGuard, SaysTheSameAsTestsOfAllTriangles) {
  int crossings = 0;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Rng rng(trial);
    const SurfaceMesh sheets = two_sheets(6, 0.2, rng);
    RefinementMesh mesh(sheets);
    RefinementDisk disk(mesh);
    set_clearances(mesh);
    CrossingGuard guard(mesh, 1);
    // One triangle of the lower sheet is split at a point up to twice the gap above it.
    const auto seed = static_cast<std::uint32_t>(rng.below(72));
    const double height = 0.4 * rng.uniform();
    const Vec3 p = centroid_of(sheets, seed) + Vec3{0, 0, height};
    const bool expected = crosses_by_brute_force(sheets, p, seed);
    ASSERT_EQ(guard_crosses(disk, guard, p, height, seed), expected) << "trial " << trial;
    crossings += expected ? 1 : 0;
  }
  EXPECT_GT(crossings, 20);
  EXPECT_LT(crossings, 180);
}

TEST(CrossingGuard, ForgetsTrianglesThatAreGone) {
  Rng rng(1);
  const SurfaceMesh sheets = two_sheets(4, 0.2, rng);
  RefinementMesh mesh(sheets);
  RefinementDisk disk(mesh);
  set_clearances(mesh);
  CrossingGuard guard(mesh, 1);
  const std::uint32_t seed = 12;
  const Vec3 p = centroid_of(sheets, seed) + Vec3{0, 0, 0.5};
  ASSERT_TRUE(guard_crosses(disk, guard, p, 0.5, seed));
  for (std::uint32_t t = 32; t < mesh.triangles.size(); ++t) guard.forget(t);  // the upper sheet
  guard.forget(seed);
  EXPECT_FALSE(guard_crosses(disk, guard, p, 0.5, seed));
}

// Spacings of very different sizes stretch triangles over many powers of ten; the guard must keep and drop them alike.
TEST(CrossingGuard, KeepsTrianglesOfAnySize) {
  for (const double stretch : {1e3, 1e9, 1e12, 1e18, 1e24}) {
    Rng rng(3);
    SurfaceMesh sheets = two_sheets(4, 0.2, rng);
    for (Vec3& p : sheets.points) p = {stretch * p.x, stretch * p.y, p.z};
    RefinementMesh mesh(sheets);
    RefinementDisk disk(mesh);
    set_clearances(mesh);
    CrossingGuard guard(mesh, 1);
    const Vec3 p = centroid_of(sheets, 12) + Vec3{0, 0, 0.5};
    const bool before = guard_crosses(disk, guard, p, 0.5, 12);
    if (stretch < 1e18) {
      EXPECT_TRUE(before) << stretch;
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) guard.forget(t);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) guard.learn(t);
    EXPECT_EQ(guard_crosses(disk, guard, p, 0.5, 12), before) << stretch;
  }
}

TEST(CrossingGuard, ClearancesNearAPointAreCleared) {
  Rng rng(2);
  SurfaceMesh sheets = two_sheets(4, 0.2, rng);
  for (double& height : sheets.pole_heights) height = 100;  // wrong
  const std::uint32_t seed = 12;
  const Vec3 p = centroid_of(sheets, seed) + Vec3{0, 0, 0.5};
  RefinementMesh mesh(sheets);
  RefinementDisk disk(mesh);
  set_clearances(mesh);
  CrossingGuard before(mesh, 1);
  EXPECT_FALSE(guard_crosses(disk, before, p, 0.5, seed));
  clear_clearances_near(mesh, std::vector<Vec3>{p});
  CrossingGuard after(mesh, 1);
  EXPECT_TRUE(guard_crosses(disk, after, p, 0.5, seed));
}

// A floor and a wall at its edge: a point behind the wall pulls the floor's star through it. No other sheet is near.
TEST(CrossingGuard, SeesFoldsOverNeighbours) {
  int folds = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Rng rng(trial);
    SurfaceMesh scene;
    scene.points = {{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}, {0.5, rng.uniform(-0.2, 0.4), 1}};
    scene.pole_heights.assign(4, 100);
    scene.triangles = {{0, 2, 1}, {0, 1, 3}};
    scene.neighbours = {{kNoSide, 4 + 2, kNoSide}, {kNoSide, kNoSide, 0 + 1}};
    RefinementMesh mesh(scene);
    RefinementDisk disk(mesh);
    set_clearances(mesh);
    CrossingGuard guard(mesh, 1);
    const Vec3 p{rng.uniform(0.2, 0.8), rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.6)};
    const bool crosses = crosses_by_brute_force(scene, p, 0);
    const bool found = guard_crosses(disk, guard, p, 1, 0);
    EXPECT_TRUE(crosses || !found) << "trial " << trial;
    // Seen from the floor's inside the wall must turn to the point by more than a right angle.
    const Vec3 wall = cross(scene.points[1] - scene.points[0], scene.points[3] - scene.points[0]);
    const Vec3 star = cross(scene.points[0] - p, scene.points[1] - p);
    if (dot(wall, -1.0 * star) < 0) {
      EXPECT_EQ(found, crosses) << "trial " << trial;
    }
    folds += found ? 1 : 0;
  }
  EXPECT_GT(folds, 20);
}

// Triangles around a vertex, crumpled; all the way around it, or with a gap.
SurfaceMesh crumpled_fan(std::uint32_t count, bool closed, Rng& rng) {
  SurfaceMesh fan;
  fan.points.push_back({0, 0, 0});
  const std::uint32_t ring = closed ? count : count + 1;
  for (std::uint32_t i = 0; i < ring; ++i) {
    const double angle = 2 * 3.14159265 * i / ring;
    fan.points.push_back({std::cos(angle), std::sin(angle), rng.uniform(-2, 2)});
  }
  fan.pole_heights.assign(fan.points.size(), 100);
  for (std::uint32_t i = 0; i < count; ++i) {
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % ring});
    const std::uint32_t next = (i + 1) % count, last = (i + count - 1) % count;
    fan.neighbours.push_back(
        {kNoSide, closed || i + 1 < count ? 4 * next + 2 : kNoSide, closed || i > 0 ? 4 * last + 1 : kNoSide});
  }
  return fan;
}

// What lies around a triangle far off the surface is tested in full, although the clearances say that all is well.
TEST(CrossingGuard, TestsAllStarsBesideATriangleFarOffTheSurface) {
  int crossings = 0, missed_otherwise = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    Rng rng(trial);
    const SurfaceMesh fan = crumpled_fan(6, trial % 2 == 0, rng);
    const auto seed = static_cast<std::uint32_t>(rng.below(6));
    const auto stays = static_cast<std::uint32_t>((seed + 2 + trial % 3) % 6);
    const Vec3 p = centroid_of(fan, seed) + Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const bool expected = crosses_by_brute_force(fan, p, seed);
    crossings += expected ? 1 : 0;
    const auto answer = [&](const SurfaceDelaunayBall& ball, bool has_hit, bool says_so) {
      RefinementMesh mesh(fan);
      set_clearances(mesh);
      mesh.triangles[stays].ball = ball;
      mesh.triangles[stays].set(RefinementMesh::Triangle::kNoHit, !has_hit);
      RefinementDisk disk(mesh);
      CrossingGuard guard(mesh, 1);
      if (says_so) guard.mark_if_far_off(stays);
      return guard_crosses(disk, guard, p, 1, seed);
    };
    const SurfaceDelaunayBall near{centroid_of(fan, stays), 0.25}, far{{50, 50, 50}, 7500};
    ASSERT_EQ(answer(far, true, true), expected) << "trial " << trial;
    ASSERT_EQ(answer(near, false, false), expected) << "trial " << trial;
    ASSERT_EQ(answer(near, true, true), answer(near, true, false)) << "trial " << trial;
    missed_otherwise += expected && !answer(far, true, false) ? 1 : 0;
  }
  EXPECT_GT(crossings, 100);
  EXPECT_LT(crossings, 900);
  EXPECT_GT(missed_otherwise, 10);
}

// A polygon that goes around once or twice and its star from a point within.
TEST(CrossingGuard, SeesWhetherAStarMeetsItself) {
  int crossings = 0, once = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    Rng rng(trial);
    constexpr std::uint32_t kCorners = 7;
    const double turns = trial % 3 == 0 ? 2 : 1;
    SurfaceMesh polygon;
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      const double angle = 2 * 3.14159265 * turns * (i + 0.8 * rng.uniform()) / kCorners;
      polygon.points.push_back({std::cos(angle), std::sin(angle), rng.uniform(-1, 1)});
    }
    for (std::uint32_t i = 1; i + 1 < kCorners; ++i) polygon.triangles.push_back({0, i, i + 1});
    set_side_adjacency(polygon);
    polygon.pole_heights.assign(kCorners, 0.01);
    const Vec3 p{rng.uniform(-0.6, 0.6), rng.uniform(-0.6, 0.6), rng.uniform(-0.5, 0.5)};
    RefinementMesh mesh(polygon);
    set_clearances(mesh);
    RefinementDisk disk(mesh);
    const RefinementCandidate candidate{.point = p, .ball_radius = 1, .seed = 2};
    disk.grow(candidate, [](std::uint32_t) { return SurfaceDelaunayBall{{}, 100}; });
    ASSERT_EQ(disk.order_rim(candidate), RefinementDisk::Shape::kDisk);

    polygon.points.push_back(p);
    bool expected = false;
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        expected |= triangle_contact(polygon.points, {kCorners, i, (i + 1) % kCorners},
                                     {kCorners, j, (j + 1) % kCorners}) != TriangleContact::kNone;
      }
    }
    CrossingGuard guard(mesh, 1);
    ASSERT_EQ(guard.crosses(p, {0, 0, 1}, 1, disk), expected) << "trial " << trial;
    crossings += expected ? 1 : 0;
    once += turns == 1 && !expected ? 1 : 0;
  }
  EXPECT_GT(crossings, 300);
  EXPECT_GT(once, 300);
}

}  // namespace
}  // namespace deliso
