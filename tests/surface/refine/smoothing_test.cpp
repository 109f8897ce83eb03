// At its end stage 2 moves vertices along the isosurface to where the angles around them are larger.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/base/observer.h"
#include "surface/base/sizes.h"
#include "surface/deliso.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/guard/clearances.h"
#include "surface/refine/refine_loop.h"
#include "surface/verification/verification.h"
#include "tests/support/refine_runs.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::fine_options;
using testing::run;
using testing::stage1_mesh;

RefineOptions smoothing_options(int passes) {
  RefineOptions options = fine_options();
  options.slab_triangles = 400;
  options.smoothing_passes = passes;
  return options;
}

struct Angles {
  double least = 90, mean = 0;  // degrees, of each triangle's smallest
};

Angles angles_of(const SurfaceMesh& mesh) {
  Angles angles;
  for (const auto& t : mesh.triangles) {
    const double sine = sine_of_least_angle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const double degrees = std::asin(std::min(1.0, sine)) * 180 / 3.14159265358979;
    angles.least = std::min(angles.least, degrees);
    angles.mean += degrees / static_cast<double>(mesh.triangles.size());
  }
  return angles;
}

// Connections are those of the mesh without smoothing, but for what the rest of the slabs comes to.
TEST(Smoothing, MakesAnglesLargerOnTheIsosurface) {
  for (const char* const name : {"torus", "gyroid", "double_torus"}) {
    SCOPED_TRACE(name);
    const auto scene = field_scene(name, 24);
    SurfaceMesh plain = stage1_mesh(*scene), smooth = plain;
    run(plain, *scene, smoothing_options(0));
    const RefineStats stats = run(smooth, *scene, smoothing_options(1));
    EXPECT_GT(stats.moves, std::ssize(plain.points) / 10);
    EXPECT_NEAR(static_cast<double>(smooth.points.size()), static_cast<double>(plain.points.size()),
                0.02 * static_cast<double>(plain.points.size()));
    EXPECT_GT(angles_of(smooth).mean, angles_of(plain).mean + 1);
    EXPECT_GE(angles_of(smooth).least, angles_of(plain).least - 0.5);
    EXPECT_EQ(self_intersections(smooth.points, smooth.triangles).crossing_pairs, 0);
    for (const Vec3& p : smooth.points) {
      EXPECT_LT(std::abs(scene->isosurface->value(p)), 1e-9 * (1 + norm(scene->isosurface->gradient(p))));
    }
  }
}

// What the criteria ask for still holds wherever no insertion was refused.
TEST(Smoothing, KeepsTheCriteria) {
  const auto scene = field_scene("gyroid", 24);
  SurfaceMesh mesh = stage1_mesh(*scene);
  const RefineOptions options = smoothing_options(2);
  std::vector<SurfaceDelaunayBall> balls;
  const RefineStats stats = run(mesh, *scene, options, &balls);
  ASSERT_GT(stats.moves, 100);
  std::int64_t failing = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Circumcircle circle = circumcircle(mesh.points[a], mesh.points[b], mesh.points[c]);
    const double h = distance(circle.center, balls[t].center);
    const double l = std::sqrt(
        std::min({squared_distance(mesh.points[a], mesh.points[b]), squared_distance(mesh.points[b], mesh.points[c]),
                  squared_distance(mesh.points[c], mesh.points[a])}));
    const double limit = 1 + 1e-9;
    const bool fails = h > options.epsilon1 * circle.radius * limit || circle.radius > options.rho * l * limit;
    failing += fails && circle.radius > options.r_min * limit ? 1 : 0;
  }
  EXPECT_LE(failing, std::accumulate(stats.refused.begin(), stats.refused.end(), std::int64_t{0}));
}

TEST(Smoothing, KeepsNoiseProvenAndNear) {
  std::int64_t moves = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const ScalarGrid grid = generate_field("noise", 8, seed);
    MeshingOptions options;
    options.parameters.stage2.h_min = 0;
    options.parameters.shape.smoothing = 0;
    const MeshingResult plain = mesh_isosurface(grid, 127.5, options);
    options.parameters.shape.smoothing = 2;
    const MeshingResult smooth = mesh_isosurface(grid, 127.5, options);
    moves += smooth.refine.moves;
    EXPECT_TRUE(is_proven(smooth.certificate)) << seed;
    const Verification plain_check = verify_mesh(plain.mesh, grid, plain.isovalue_used);
    const Verification check = verify_mesh(smooth.mesh, grid, smooth.isovalue_used);
    EXPECT_TRUE(check.proven) << seed;
    EXPECT_LT(check.distance.mesh_to_isosurface.mean_voxels, 1.05 * plain_check.distance.mesh_to_isosurface.mean_voxels)
        << seed;
    EXPECT_LT(check.distance.isosurface_to_mesh.mean_voxels, 1.05 * plain_check.distance.isosurface_to_mesh.mean_voxels)
        << seed;
  }
}

TEST(Smoothing, IsTheSameForAnyNumberOfThreads) {
  const auto scene = testing::noise_scene({12, 12, 24}, 3);
  const SurfaceMesh start = stage1_mesh(*scene);
  SurfaceMesh one = start;
  RefineOptions options = smoothing_options(1);
  const RefineStats stats = run(one, *scene, options);
  EXPECT_GT(stats.moves, 0);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    SurfaceMesh several = start;
    EXPECT_EQ(run(several, *scene, options).moves, stats.moves);
    EXPECT_EQ(several.points, one.points);
    EXPECT_EQ(several.triangles, one.triangles);
  }
}

// Vertices of the start are moved, too: a restart has to put them back where they were.
TEST(Smoothing, IsTakenBackAndAppliedAgain) {
  const auto scene = field_scene("torus", 20);
  const RefineOptions options = smoothing_options(1);
  RefinementPart part;
  part.mesh = RefinementMesh(stage1_mesh(*scene));
  part.smoothing = Smoothing::kAll;
  set_clearances(part.mesh);
  RefineStats stats;
  RefineLoop loop(part, *scene->isosurface, options, stats);
  loop.measure_all(1);
  const auto points_of = [&] {
    std::vector<Vec3> points;
    for (const RefinementMesh::Vertex& v : part.mesh.vertices) points.push_back(v.point);
    return points;
  };
  const std::vector<Vec3> before = points_of();
  Controls controls(BudgetParameters{}, nullptr, {});
  loop.run(controls, 1);
  const std::vector<Vec3> after = points_of();
  ASSERT_GT(after.size(), before.size());
  EXPECT_FALSE(std::equal(before.begin(), before.end(), after.begin())) << "no vertex of the start has moved";
  const RefinementChange change = loop.take_back();
  EXPECT_EQ(points_of(), before);
  change.redo(part.mesh);
  EXPECT_EQ(points_of(), after);
}

class MoveListener : public Observer {
 public:
  void improved(const RefinementMesh& /*mesh*/, std::string_view why) override { told += why == "angles" ? 1 : 0; }
  int told = 0;
};

TEST(Smoothing, IsToldToWhoeverWatches) {
  const auto scene = field_scene("torus", 20);
  RefineOptions options = smoothing_options(1);
  options.slab_triangles = 1000000;  // slabs cannot be watched
  SurfaceMesh alone = stage1_mesh(*scene), watched = alone;
  run(alone, *scene, options);
  MoveListener observer;
  options.observer = &observer;
  run(watched, *scene, options);
  EXPECT_EQ(observer.told, 1);
  EXPECT_EQ(watched.points, alone.points);
}

// Fine thresholds must not lapse at the height that is usual at the paper's.
TEST(LapsedCriteria, UsualHMinFollowsTheThresholds) {
  Parameters parameters;
  const double usual = effective_h_min(parameters);
  EXPECT_GT(usual, 0);
  parameters.stage2.epsilon1 /= 2;
  EXPECT_DOUBLE_EQ(effective_h_min(parameters), usual / 4);
  parameters.stage2.epsilon2 /= 10;
  EXPECT_DOUBLE_EQ(effective_h_min(parameters), usual / 100);
  parameters.stage2 = {};
  parameters.stage2.epsilon1 *= 2;
  EXPECT_EQ(effective_h_min(parameters), usual);
  parameters.stage2.rho = 1.5;
  EXPECT_EQ(effective_h_min(parameters), 0);
  parameters.stage2.h_min = 0.04;
  EXPECT_EQ(effective_h_min(parameters), 0.04);
  parameters.size.max_error = 0.1;
  EXPECT_EQ(effective_h_min(parameters), 0);
}

}  // namespace
}  // namespace deliso
