// The shape stage in whole runs: better angles, the same topology, proven by mesher and verification.
#include "surface/shape/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/certificate/geometry_check.h"
#include "surface/deliso.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

MeshingResult meshed(const ScalarGrid& grid, double isovalue, int rounds, int threads = 1, double rho = 2) {
  MeshingOptions options;
  options.parameters.shape.rounds = rounds;
  options.parameters.shape.smoothing = 0;
  options.parameters.stage2.h_min = 0;
  options.parameters.stage2.rho = rho;
  options.threads = threads;
  return mesh_isosurface(grid, isovalue, options);
}

ScalarGrid random_mask(int side, std::uint64_t seed) {
  Rng rng(seed);
  return testing::sampled({side, side, side}, [&](const Vec3&) { return static_cast<double>(rng.below(2)); });
}
ScalarGrid random_noise(int side, std::uint64_t seed) {
  Rng rng(seed);
  return testing::sampled({side, side, side}, [&](const Vec3&) { return std::floor(256 * rng.uniform()); });
}

std::int64_t count_below(const TriangleMesh& mesh, double sine) {
  return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return sine_of_least_angle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) < sine;
  });
}

TEST(Shape, ImprovesNoiseAndMasksAndKeepsThePromise) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const bool is_mask = seed % 2 == 0;
    const ScalarGrid grid = is_mask ? random_mask(6, seed) : random_noise(6, seed);
    const double isovalue = is_mask ? 0.5 : 127.5;
    const MeshingResult before = meshed(grid, isovalue, 0);
    const MeshingResult after = meshed(grid, isovalue, 4);
    ASSERT_TRUE(is_proven(before.certificate)) << seed;
    EXPECT_TRUE(is_proven(after.certificate)) << seed;
    EXPECT_TRUE(verify_mesh(after.mesh, grid, after.isovalue_used).proven) << seed;
    const MeshQuality old_quality = measure_quality(before.mesh), quality = measure_quality(after.mesh);
    EXPECT_GE(quality.min_angle_degrees, old_quality.min_angle_degrees) << seed;
    EXPECT_GT(quality.min_angle_degrees, 0.5) << seed;
    EXPECT_GT(after.shape.bad_before, 0) << seed;
    EXPECT_LT(after.shape.bad_after, after.shape.bad_before / 4) << seed;
  }
}

// On unit spacing mesh space is the world.
TEST(Shape, CountsTheTrianglesThatItLeaves) {
  const ScalarGrid grid = random_noise(8, 11);
  const MeshingResult result = meshed(grid, 100.5, 1, 1, 1);
  const double goal = 0.5;  // sin 30 degrees
  EXPECT_EQ(result.shape.bad_after, count_below(result.mesh, goal));
  EXPECT_EQ(result.shape.bad_before, count_below(meshed(grid, 100.5, 0, 1, 1).mesh, goal));
  ASSERT_FALSE(result.shape.worst.empty());
  EXPECT_NEAR(result.shape.worst.front().degrees(), measure_quality(result.mesh).min_angle_degrees, 1e-6);
  EXPECT_TRUE(std::is_sorted(result.shape.worst.begin(), result.shape.worst.end(),
                             [](const BadTriangle& a, const BadTriangle& b) { return a.sine < b.sine; }));
}

// Steps and searches would find as little for them as before, in as long a time: a few components come from finer cubes
// or were brought near, and all others would be tried again.
TEST(Shape, LeavesAloneWhatItHasLeftBefore) {
  Rng rng(36);
  const ScalarGrid grid = testing::sampled({10, 10, 10}, [&](const Vec3&) { return rng.below(2) == 0 ? 0.0 : 200.0; });
  const MeshingResult before = meshed(grid, 0.5, 0);
  const Isosurface isosurface(grid, before.isovalue_used, SearchOptions());
  const IsosurfaceTopology topology = exact_topology(grid, before.isovalue_used);
  const ExactSurface surface{isosurface, topology};
  SurfaceMesh mesh;
  mesh.points = before.mesh.points;
  mesh.triangles = before.mesh.triangles;
  Controls controls({}, {}, {});
  KnownTriangles left;
  ShapeStats first, second;
  improve_shape(mesh, surface, shape_options({}), controls, first, left);
  const SurfaceMesh improved = mesh;
  ASSERT_GT(count_below(to_world(improved, isosurface), std::sin(10 * std::numbers::pi / 180)), 0);
  improve_shape(mesh, surface, shape_options({}), controls, second, left);
  EXPECT_GT(first.bad_before, 100);
  EXPECT_EQ(second.bad_before, 0);
  EXPECT_EQ(second.search.searches, 0);
  EXPECT_TRUE(mesh.points == improved.points);
  EXPECT_TRUE(mesh.triangles == improved.triangles);
}

TEST(Shape, IsTheSameForAnyNumberOfThreads) {
  const ScalarGrid grid = random_noise(9, 12);
  const MeshingResult one = meshed(grid, 127.5, 4);
  for (const int threads : {2, 3}) {
    const MeshingResult several = meshed(grid, 127.5, 4, threads);
    EXPECT_EQ(one.mesh.points, several.mesh.points);
    EXPECT_EQ(one.mesh.triangles, several.mesh.triangles);
  }
}

// Where bad triangles crowd in more than a thousand voxels, they are worked on in several passes, by blocks.
TEST(Shape, IsTheSameForAnyNumberOfThreadsInSeveralPasses) {
  Rng rng(15);
  const ScalarGrid grid = testing::sampled({110, 8, 5}, [&](const Vec3&) { return std::floor(256 * rng.uniform()); });
  MeshingOptions options;
  options.parameters.shape.min_angle = 25;
  options.parameters.shape.rounds = 1;
  options.threads = 1;
  const MeshingResult one = mesh_isosurface(grid, 127.5, options);
  EXPECT_GT(one.shape.bad_before, 2500);
  EXPECT_LT(one.shape.bad_after, one.shape.bad_before * 2 / 3);
  EXPECT_TRUE(is_proven(one.certificate));
  options.threads = 3;
  const MeshingResult several = mesh_isosurface(grid, 127.5, options);
  EXPECT_EQ(one.mesh.points, several.mesh.points);
  EXPECT_EQ(one.mesh.triangles, several.mesh.triangles);
}

// A smooth ball has no triangle to improve: the stage must leave it alone.
TEST(Shape, LeavesGoodMeshesAlone) {
  const ScalarGrid grid = testing::sampled({20, 20, 20}, testing::ball_field({9.3, 9.6, 9.4}, 6));
  const MeshingResult before = meshed(grid, 0, 0);
  const MeshingResult after = meshed(grid, 0, 4);
  if (after.shape.bad_before == 0) {
    EXPECT_EQ(before.mesh.points, after.mesh.points);
    EXPECT_EQ(before.mesh.triangles, after.mesh.triangles);
  } else {
    EXPECT_EQ(after.shape.bad_after, 0);
  }
}

// A vertex of a ball's mesh that has been moved beyond its neighbours: its triangles cross those beyond.
TEST(Shape, ReplacesTrianglesThatCross) {
  const ScalarGrid grid = testing::sampled({20, 20, 20}, testing::ball_field({9.3, 9.6, 9.4}, 6));
  const testing::Scene scene("ball", grid, 0);
  for (const std::uint32_t moved : {3U, 50U, 200U}) {
    SCOPED_TRACE(moved);
    TriangleMesh ball = mesh_isosurface(grid, 0, {}).mesh;
    SurfaceMesh mesh;
    mesh.points = std::move(ball.points);
    mesh.triangles = std::move(ball.triangles);
    const Vec3 center{9.3, 9.6, 9.4}, from = mesh.points[moved];
    const Vec3 aside = cross(from - center, {0.48, 0.6, 0.64});
    const Vec3 outward = from + 3.5 * aside / norm(aside) - center;
    SearchCounters counters;
    const Line line{center, outward / norm(outward)};
    const auto hit = scene.isosurface->nearest_falling_hit(line, 12, counters);
    ASSERT_TRUE(hit);
    mesh.points[moved] = line.at(*hit);
    const SelfIntersections before = self_intersections(mesh.points, mesh.triangles, 1000, 1);
    ASSERT_GT(before.crossing_pairs, 0);
    std::vector<std::uint32_t> crossing;
    for (const TrianglePair& pair : before.crossing) crossing.insert(crossing.end(), {pair.first, pair.second});
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    Controls controls({}, {}, {});
    ShapeStats stats;
    replace_wrong_triangles(mesh, crossing, scene.surface(), shape_options({}), controls, stats);
    EXPECT_EQ(self_intersections(mesh.points, mesh.triangles, 0, 1).crossing_pairs, 0);
    const MeshTopology topology = mesh_topology(mesh.points.size(), mesh.triangles, 1);
    ASSERT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].euler_characteristic(), 2);
    EXPECT_TRUE(topology.boundary_edges.empty());
  }
}

// The triangles of a ball's mesh lie below it, the largest farther than is promised here.
TEST(Shape, ReplacesTrianglesThatAreTooFar) {
  constexpr double kMost = 0.05;
  const ScalarGrid grid = testing::sampled({20, 20, 20}, testing::ball_field({9.3, 9.6, 9.4}, 6));
  const testing::Scene scene("ball", grid, 0);
  MeshingOptions coarse;
  coarse.parameters.shape.rounds = 0;
  TriangleMesh ball = mesh_isosurface(grid, 0, coarse).mesh;
  SurfaceMesh mesh;
  mesh.points = std::move(ball.points);
  mesh.triangles = std::move(ball.triangles);
  const Promise promise{.max_distance = kMost};
  const GeometryCheck before = check_distances(mesh, scene.surface(), promise);
  ASSERT_GT(before.far_triangles.size(), 5u);
  ASSERT_LT(before.far_triangles.size(), mesh.triangles.size());
  ShapeOptions options = shape_options({});
  Controls controls({}, {}, {});
  ShapeStats stats;
  SurfaceMesh otherwise = mesh;
  replace_wrong_triangles(otherwise, before.far_triangles, scene.surface(), options, controls, stats);
  EXPECT_GT(check_distances(otherwise, scene.surface(), promise).mesh_off, 0) << "there is nothing to show";
  options.max_sample = kMost;
  replace_wrong_triangles(mesh, before.far_triangles, scene.surface(), options, controls, stats);
  EXPECT_EQ(check_distances(mesh, scene.surface(), promise).mesh_off, 0);
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles, 0, 1).crossing_pairs, 0);
  const MeshTopology topology = mesh_topology(mesh.points.size(), mesh.triangles, 1);
  ASSERT_EQ(topology.components.size(), 1u);
  EXPECT_EQ(topology.components[0].euler_characteristic(), 2);
}

TEST(Shape, IsLeftOutWithoutRepair) {
  MeshingOptions options;
  options.parameters.repair.max_rounds = 0;
  const MeshingResult result = mesh_isosurface(random_noise(6, 13), 127.5, options);
  EXPECT_EQ(result.shape.bad_before, 0);
}

// The limit of rho is the angle across from an edge that is the circumradius over rho.
TEST(Shape, AimsAtTheAngleThatRhoBounds) {
  Parameters parameters;
  EXPECT_NEAR(shape_options(parameters).min_angle * 180 / std::numbers::pi, 10, 1e-12);
  parameters.stage2.rho = 1;
  EXPECT_NEAR(shape_options(parameters).min_angle * 180 / std::numbers::pi, 30, 1e-12);
  parameters.shape.min_angle = 20;
  EXPECT_NEAR(shape_options(parameters).min_angle * 180 / std::numbers::pi, 20, 1e-12);
}

}  // namespace
}  // namespace deliso
