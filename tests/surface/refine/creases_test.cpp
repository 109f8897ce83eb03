// Stage 2 where the isosurface has creases everywhere, as in noise: h_min ends refinement there, and edges across folds
// are flipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/base/observer.h"
#include "surface/deliso.h"
#include "surface/intersection/self_intersection.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/refine.h"
#include "surface/verification/verification.h"
#include "tests/support/refine_runs.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::fine_options;
using testing::run;
using testing::stage1_mesh;

RefineOptions options_with(double h_min) {
  RefineOptions options = fine_options();
  options.h_min = h_min;
  return options;
}

// By edges and their triangles alone.
std::int64_t euler_characteristic_of(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
  }
  for (const auto& [edge, count] : edges) EXPECT_LE(count, 2);
  return std::ssize(mesh.points) - std::ssize(edges) + std::ssize(mesh.triangles);
}

TEST(Creases, WhatIsNearEnoughIsNotRefined) {
  const auto scene = field_scene("torus", 24);
  const SurfaceMesh start = stage1_mesh(*scene);
  SurfaceMesh all = start, near_enough = start;
  run(all, *scene, options_with(0));
  const RefineOptions options = options_with(0.08);
  std::vector<SurfaceDelaunayBall> balls;
  const RefineStats stats = run(near_enough, *scene, options, &balls);
  EXPECT_LT(near_enough.points.size(), all.points.size() * 19 / 20);
  EXPECT_GT(near_enough.points.size(), start.points.size());
  std::int64_t failing = 0, lapsed = 0;
  for (std::size_t t = 0; t < near_enough.triangles.size(); ++t) {
    const auto& v = near_enough.triangles[t];
    const Circumcircle circle =
        circumcircle(near_enough.points[v[0]], near_enough.points[v[1]], near_enough.points[v[2]]);
    const double h = distance(circle.center, balls[t].center);
    const bool is_far = h > options.epsilon1 * circle.radius * (1 + 1e-9) && circle.radius > options.r_min;
    failing += is_far && (h > options.h_min * (1 + 1e-9) || circle.radius > 1 + 1e-9) ? 1 : 0;
    lapsed += is_far && h <= options.h_min ? 1 : 0;
  }
  EXPECT_LE(failing, std::accumulate(stats.refused.begin(), stats.refused.end(), std::int64_t{0}));
  EXPECT_GT(lapsed, 0);
}

// A flip replaces two triangles by two others: topology and embedding stay, whatever the field.
TEST(Creases, FlippedEdgesKeepTheMesh) {
  std::int64_t flips = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto scene = testing::noise_scene({8, 7, 9}, seed);
    SurfaceMesh mesh = stage1_mesh(*scene);
    const std::int64_t before = euler_characteristic_of(mesh);
    const bool is_embedded = self_intersections(mesh.points, mesh.triangles).crossing_pairs == 0;
    const RefineStats stats = run(mesh, *scene, options_with(0.05));
    EXPECT_EQ(euler_characteristic_of(mesh), before) << seed;
    if (is_embedded) {
      EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0) << seed;
    }
    flips += stats.flips;
  }
  EXPECT_GT(flips, 20);
}

TEST(Creases, NothingIsFlippedWithoutHMin) {
  const auto scene = testing::noise_scene({8, 7, 9}, 1);
  SurfaceMesh mesh = stage1_mesh(*scene);
  EXPECT_EQ(run(mesh, *scene, options_with(0)).flips, 0);
}

TEST(Creases, AnyNumberOfThreadsGivesTheSameMesh) {
  const auto scene = testing::noise_scene({12, 12, 24}, 3);
  const SurfaceMesh start = stage1_mesh(*scene);
  SurfaceMesh one = start;
  RefineOptions options = options_with(0.05);
  const RefineStats stats = run(one, *scene, options);
  EXPECT_GT(stats.flips, 0);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    SurfaceMesh several = start;
    EXPECT_EQ(run(several, *scene, options).flips, stats.flips);
    EXPECT_EQ(several.points, one.points);
    EXPECT_EQ(several.triangles, one.triangles);
  }
}

class FlipCounter : public Observer {
 public:
  void improved(const RefinementMesh& mesh, std::string_view why) override {
    EXPECT_EQ(why, "folds");
    ++told;
    triangles = mesh.triangles.size();
  }
  int told = 0;
  std::size_t triangles = 0;
};

TEST(Creases, WatchedRunsAreTheSame) {
  const auto scene = testing::noise_scene({8, 7, 9}, 1);
  RefineOptions options = options_with(0.05);
  options.slab_triangles = 1000000;  // slabs cannot be watched
  SurfaceMesh alone = stage1_mesh(*scene), watched = alone;
  const RefineStats stats = run(alone, *scene, options);
  FlipCounter observer;
  options.observer = &observer;
  EXPECT_EQ(run(watched, *scene, options).flips, stats.flips);
  EXPECT_GT(stats.flips, 0);
  EXPECT_GT(observer.told, 0);
  EXPECT_GT(observer.triangles, 0u);
  EXPECT_EQ(watched.points, alone.points);
  EXPECT_EQ(watched.triangles, alone.triangles);
}

struct NoiseRun {
  std::int64_t vertices = 0;
  DistanceCheck distance;
};

NoiseRun noise_run(std::uint64_t seed, double h_min, double r_min) {
  const ScalarGrid grid = generate_field("noise", 12, seed);
  MeshingOptions options;
  options.parameters.stage2.h_min = h_min;
  options.parameters.stage2.r_min = r_min;
  const MeshingResult result = mesh_isosurface(grid, 127.5, options);
  EXPECT_TRUE(is_proven(result.certificate)) << seed << ' ' << h_min;
  const Verification check = verify_mesh(result.mesh, grid, 127.5);
  EXPECT_TRUE(check.proven) << seed << ' ' << h_min;
  return {std::ssize(result.mesh.points), check.distance};
}

// About half of the vertices that the paper's criteria take are as near to the surface; and of as many vertices, with a
// larger r_min in place of h_min, the mesh is farther off.
TEST(Creases, NoiseTakesHalfOfTheVertices) {
  constexpr double kHMin = 0.08, kRMin = 0.001, kLargerRMin = 0.0015;
  const NoiseRun paper = noise_run(2, 0, kRMin), larger = noise_run(2, 0, kLargerRMin);
  const NoiseRun lapsed = noise_run(2, kHMin, kRMin);
  EXPECT_LE(lapsed.vertices, paper.vertices * 52 / 100);
  const auto off = [](const NoiseRun& run) { return run.distance.mesh_to_isosurface; };
  EXPECT_LE(off(lapsed).mean_voxels, 1.1 * off(paper).mean_voxels);
  EXPECT_LE(off(lapsed).max_voxels, 1.1 * off(paper).max_voxels);
  EXPECT_GE(larger.vertices, lapsed.vertices * 95 / 100);
  EXPECT_GE(off(larger).mean_voxels, 1.15 * off(lapsed).mean_voxels);
}

}  // namespace
}  // namespace deliso
