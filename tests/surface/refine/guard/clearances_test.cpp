// Clearances against a look at every triangle and every pair of vertices.
#include "surface/refine/guard/clearances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {
namespace {

// An uneven sheet of n x n squares, cut into triangles; every pole height is `pole_height`.
RefinementMesh uneven_sheet(std::uint32_t n, double pole_height, Rng& rng) {
  SurfaceMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      mesh.points.push_back({i + 0.4 * rng.uniform(), j + 0.4 * rng.uniform(), 2 * rng.uniform()});
      mesh.pole_heights.push_back(pole_height);
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t at = j * (n + 1) + i;
      mesh.triangles.push_back({at, at + 1, at + n + 2});
      mesh.triangles.push_back({at, at + n + 2, at + n + 1});
    }
  }
  mesh.neighbours.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  return RefinementMesh(mesh);
}

// The corners of triangles whose boxes are nearer than 3 voxels to one of the points.
std::vector<bool> near_by_brute_force(const RefinementMesh& mesh, const std::vector<Vec3>& points) {
  std::vector<bool> near(mesh.vertices.size(), false);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Box3 box = mesh.box_of(t);
    for (const Vec3& p : points) {
      if (distance(p, box.clamp(p)) >= 3) continue;
      for (const std::uint32_t v : mesh.triangles[t].corners) near[v] = true;
    }
  }
  return near;
}

TEST(Clearances, VanishNearSuspectsAndNowhereElse) {
  constexpr double kHigh = 50;  // more than the sheet is wide: only distances along edges bound what is left
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    RefinementMesh mesh = uneven_sheet(16, kHigh, rng);
    set_clearances(mesh);
    std::vector<Vec3> suspects;
    for (std::size_t i = 0; i <= seed % 3; ++i) {
      suspects.push_back({rng.uniform(-2, 19), rng.uniform(-2, 19), rng.uniform(-3, 5)});
    }
    const std::vector<bool> near = near_by_brute_force(mesh, suspects);
    clear_clearances_near(mesh, suspects);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_EQ(mesh.vertices[v].clearance == 0, near[v]) << v;
  }
}

// A clearance is at most the distance along edges to a vertex that has none.
TEST(Clearances, AreBoundedAlongEdges) {
  Rng rng(7);
  RefinementMesh mesh = uneven_sheet(16, 50, rng);
  set_clearances(mesh);
  clear_clearances_near(mesh, std::vector<Vec3>{{-2, -2, 0}});
  for (const RefinementMesh::Triangle& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const auto &a = mesh.vertices[t.corners[i]], &b = mesh.vertices[t.corners[(i + 1) % 3]];
      EXPECT_LE(b.clearance, (a.clearance + distance(a.point, b.point)) * (1 + 1e-6));
    }
  }
  EXPECT_EQ(std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& v) { return v.clearance == 50; }),
            0);
}

// Vertices on top of each other have none, whatever cell of the search they lie in.
TEST(Clearances, VanishAtDoubledVertices) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    RefinementMesh mesh = uneven_sheet(10, 50, rng);
    const std::size_t moved = rng.below(mesh.vertices.size()), onto = rng.below(mesh.vertices.size());
    const double apart = seed % 2 == 0 ? 1.9e-3 : 2.1e-3;
    const Vec3 along{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (moved == onto) continue;
    mesh.vertices[moved].point = mesh.vertices[onto].point + (apart / norm(along)) * along;
    set_clearances(mesh);
    for (const std::size_t v : {moved, onto}) EXPECT_EQ(mesh.vertices[v].clearance == 0, seed % 2 == 0) << v;
  }
}

}  // namespace
}  // namespace deliso
