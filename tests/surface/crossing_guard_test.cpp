// The guard of stage 2 against testing every triangle of the mesh.
#include "surface/crossing_guard.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"
#include "surface/self_intersection.h"

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
  return mesh;
}

bool crosses_by_brute_force(SurfaceMesh mesh, const Vec3& p, const std::vector<CrossingGuard::Edge>& rim,
                            std::uint32_t seed) {
  const auto newest = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(p);
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  triangles.erase(triangles.begin() + seed);
  const std::size_t old = triangles.size();
  for (const auto& [from, to] : rim) triangles.push_back({newest, from, to});
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
    SurfaceMesh mesh = two_sheets(6, 0.2, rng);
    CrossingGuard guard(mesh, {});
    // One triangle of the lower sheet is split at a point up to twice the gap above it.
    const auto seed = static_cast<std::uint32_t>(rng.below(72));
    const auto& v = mesh.triangles[seed];
    const Vec3 centroid = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3;
    const double height = 0.4 * rng.uniform();
    const Vec3 p = centroid + Vec3{0, 0, height};
    const std::vector<CrossingGuard::Edge> rim = {{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}};
    std::vector<std::uint32_t> disk(mesh.triangles.size(), 0);
    disk[seed] = 1;
    const bool expected = crosses_by_brute_force(mesh, p, rim, seed);
    ASSERT_EQ(guard.crosses(p, height, rim, disk, 1), expected) << "trial " << trial;
    crossings += expected ? 1 : 0;
  }
  EXPECT_GT(crossings, 20);
  EXPECT_LT(crossings, 180);
}

TEST(CrossingGuard, ForgetsTrianglesThatAreGone) {
  Rng rng(1);
  SurfaceMesh mesh = two_sheets(4, 0.2, rng);
  CrossingGuard guard(mesh, {});
  const std::uint32_t seed = 12;
  const auto v = mesh.triangles[seed];
  const Vec3 p = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3 + Vec3{0, 0, 0.5};
  const std::vector<CrossingGuard::Edge> rim = {{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}};
  const std::vector<std::uint32_t> disk(mesh.triangles.size(), 0);
  ASSERT_TRUE(guard.crosses(p, 0.5, rim, disk, 1));
  for (std::uint32_t t = 32; t < mesh.triangles.size(); ++t) guard.forget(t);  // the upper sheet
  EXPECT_FALSE(guard.crosses(p, 0.5, rim, disk, 0));
}

// Spacings of very different sizes stretch triangles over many powers of ten; the guard must keep and drop them alike.
TEST(CrossingGuard, KeepsTrianglesOfAnySize) {
  for (const double stretch : {1e3, 1e9, 1e12, 1e18, 1e24}) {
    Rng rng(3);
    SurfaceMesh mesh = two_sheets(4, 0.2, rng);
    for (Vec3& p : mesh.points) p = {stretch * p.x, stretch * p.y, p.z};
    CrossingGuard guard(mesh, {});
    const std::vector<std::uint32_t> disk(mesh.triangles.size(), 0);
    const auto& v = mesh.triangles[12];
    const Vec3 p = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3 + Vec3{0, 0, 0.5};
    const std::vector<CrossingGuard::Edge> rim = {{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}};
    const bool before = guard.crosses(p, 0.5, rim, disk, 1);
    if (stretch < 1e18) {
      EXPECT_TRUE(before) << stretch;
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) guard.forget(t);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) guard.learn(t);
    EXPECT_EQ(guard.crosses(p, 0.5, rim, disk, 1), before) << stretch;
  }
}

TEST(CrossingGuard, TrustsNoClearanceNearASuspect) {
  Rng rng(2);
  SurfaceMesh mesh = two_sheets(4, 0.2, rng);
  for (double& height : mesh.pole_heights) height = 100;  // wrong
  const std::uint32_t seed = 12;
  const auto v = mesh.triangles[seed];
  const Vec3 p = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3 + Vec3{0, 0, 0.5};
  const std::vector<CrossingGuard::Edge> rim = {{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}};
  std::vector<std::uint32_t> disk(mesh.triangles.size(), 0);
  disk[seed] = 1;
  EXPECT_FALSE(CrossingGuard(mesh, {}).crosses(p, 0.5, rim, disk, 1));
  EXPECT_TRUE(CrossingGuard(mesh, std::vector<Vec3>{p}).crosses(p, 0.5, rim, disk, 1));
}

}  // namespace
}  // namespace deliso
