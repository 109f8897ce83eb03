// At its end stage 2 moves vertices along the isosurface to where the angles around them are larger.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/base/observer.h"
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

// Triangles larger than r_min that fail a criterion: 1 or 3, for of 2 no pole heights are kept.
std::int64_t failing_triangles(const SurfaceMesh& mesh, std::span<const SurfaceDelaunayBall> balls,
                               const RefineOptions& options) {
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
  return failing;
}

// Moves make no triangle coarse.
TEST(Smoothing, KeepsTheCriteria) {
  for (const char* const name : {"gyroid", "torus", "double_torus"}) {
    const auto scene = field_scene(name, 24);
    SurfaceMesh plain = stage1_mesh(*scene), smooth = plain;
    RefineOptions options = smoothing_options(0);
    options.slab_triangles = 1000000;  // else what slabs leave is refined after they were smoothed
    std::vector<SurfaceDelaunayBall> plain_balls, balls;
    run(plain, *scene, options, &plain_balls);
    options.smoothing_passes = 2;
    ASSERT_GT(run(smooth, *scene, options, &balls).moves, 100);
    EXPECT_LE(failing_triangles(smooth, balls, options), failing_triangles(plain, plain_balls, options)) << name;
  }
}

// A triangle's ball is that of its corners in their order, to the last bit: it may be searched again.
TEST(Smoothing, SearchingBallsAgainGivesTheSameMesh) {
  const auto scene = field_scene("gyroid", 20);
  SurfaceMesh stored = stage1_mesh(*scene), searched = stored;
  RefineOptions options = smoothing_options(1);
  run(stored, *scene, options);
  options.store_hits = false;
  run(searched, *scene, options);
  EXPECT_EQ(stored.points, searched.points);
  EXPECT_EQ(stored.triangles, searched.triangles);
}

TEST(Smoothing, KeepsNoiseProvenAndNear) {
  std::int64_t moves = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const ScalarGrid grid = generate_field("noise", 8, seed);
    MeshingOptions options;
    options.parameters.shape.smoothing = 0;
    const MeshingResult plain = mesh_isosurface(grid, 127.5, options);
    options.parameters.shape.smoothing = 1;
    const MeshingResult smooth = mesh_isosurface(grid, 127.5, options);
    moves += smooth.refine.moves;
    EXPECT_TRUE(is_proven(smooth.certificate)) << seed;
    const Verification plain_check = verify_mesh(plain.mesh, grid, plain.isovalue_used);
    const Verification check = verify_mesh(smooth.mesh, grid, smooth.isovalue_used);
    EXPECT_TRUE(check.proven) << seed;
    EXPECT_LT(check.distance.mesh_to_isosurface.mean_voxels, 1.05 * plain_check.distance.mesh_to_isosurface.mean_voxels)
        << seed;
    // At crossings with grid edges, where vertices of noise lie exactly.
    EXPECT_LT(check.distance.isosurface_to_mesh.mean_voxels,
              plain_check.distance.isosurface_to_mesh.mean_voxels + 0.001)
        << seed;
  }
  EXPECT_GT(moves, 100);
}

TEST(Smoothing, IsTheSameForAnyNumberOfThreads) {
  const auto scene = testing::noise_scene({12, 12, 24}, 3);
  const SurfaceMesh start = stage1_mesh(*scene);
  SurfaceMesh one = start;
  RefineOptions options = smoothing_options(1);
  options.h_min = 0.025;
  const RefineStats stats = run(one, *scene, options);
  EXPECT_GT(stats.moves, 500);
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
  using State = std::tuple<std::vector<Vec3>, std::vector<float>, std::vector<std::array<std::uint32_t, 3>>,
                           std::vector<Vec3>, std::vector<bool>>;
  const auto state = [&] {
    State now;
    for (const RefinementMesh::Vertex& v : part.mesh.vertices) {
      std::get<0>(now).push_back(v.point);
      std::get<1>(now).push_back(v.clearance);
    }
    for (const RefinementMesh::Triangle& t : part.mesh.triangles) {
      std::get<2>(now).push_back(t.corners);
      std::get<3>(now).push_back(t.ball.center);
      std::get<4>(now).push_back(t.is_coarse());
    }
    return now;
  };
  const State before = state();
  Controls controls(BudgetParameters{}, nullptr, {});
  loop.run(controls, 1);
  const State after = state();
  const std::vector<Vec3>&old_points = std::get<0>(before), &points = std::get<0>(after);
  ASSERT_GT(points.size(), old_points.size());
  EXPECT_FALSE(std::equal(old_points.begin(), old_points.end(), points.begin())) << "no vertex of the start has moved";
  const RefinementChange change = loop.take_back();
  EXPECT_EQ(state(), before);
  change.redo(part.mesh);
  EXPECT_EQ(state(), after);
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

}  // namespace
}  // namespace deliso
