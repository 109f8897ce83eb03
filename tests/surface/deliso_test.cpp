#include "surface/deliso.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"
#include "tests/support/topology_mesh_check.h"

namespace deliso {
namespace {

MeshingResult mesh_field(const std::string& name, std::int32_t size, MeshingOptions options = {}) {
  return mesh_isosurface(generate_field(name, size), find_analytic_field(name).isovalue, options);
}

void expect_proven(const MeshingResult& result, const ScalarGrid& grid, double isovalue) {
  EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic)
      << (result.certificate.differences.empty() ? "" : result.certificate.differences[0]);
  EXPECT_TRUE(is_proven(result.certificate)) << (result.certificate.broken.empty() ? "" : result.certificate.broken[0]);
  const Verification verification = verify_mesh(result.mesh, grid, isovalue);
  EXPECT_TRUE(verification.proven) << (verification.failures.empty() ? "" : verification.failures[0]);
}

// Whatever else holds, a mesh is an oriented manifold in the box.
void expect_valid(const MeshingResult& result, const ScalarGrid& grid) {
  EXPECT_EQ(test::mesh_facts(result.mesh.triangles).defect, "");
  Box3 box = grid.box();
  const double slack = 1e-9 * (box.diagonal() + norm(box.low) + norm(box.high));
  for (const Vec3& p : result.mesh.points) EXPECT_LE(distance(p, box.clamp(p)), slack);
}

TEST(Deliso, KnownFieldsAreMeshedWithTheirKnownTopology) {
  for (const AnalyticField& field : analytic_fields()) {
    const std::int32_t size = std::clamp(field.smallest_known_size, 12, 32);
    const auto known = field.known_topology(size);
    if (!known) continue;
    SCOPED_TRACE(field.name + " " + std::to_string(size));
    const ScalarGrid grid = generate_field(field.name, size);
    const MeshingResult result = mesh_isosurface(grid, field.isovalue, {});
    expect_proven(result, grid, field.isovalue);
    std::vector<ComponentTopology> expected;
    for (const KnownComponents& k : *known) {
      expected.insert(expected.end(), static_cast<std::size_t>(k.count), {k.euler_characteristic, k.boundary_loops});
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(test::mesh_facts(result.mesh.triangles).components, expected);
  }
}

// By the paper's criteria alone the mesh of a large smooth ball is more than a voxel off, as its size goes with that of
// the ball. Refinement goes on by distance; without repair it does not, and the run says so.
TEST(Deliso, ALargeSmoothBallIsAsNearAsPromised) {
  const ScalarGrid grid = generate_field("sphere", 160);
  const double isovalue = find_analytic_field("sphere").isovalue;
  expect_proven(mesh_isosurface(grid, isovalue, {}), grid, isovalue);
  MeshingOptions finer;
  finer.parameters.promise.max_distance = 0.25;
  const MeshingResult result = mesh_isosurface(grid, isovalue, finer);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, isovalue, {.max_distance = 0.25}).proven);
  MeshingOptions as_the_paper;
  as_the_paper.parameters.repair.max_rounds = 0;
  const MeshingResult coarse = mesh_isosurface(grid, isovalue, as_the_paper);
  EXPECT_EQ(coarse.certificate.verdict, Verdict::kHomeomorphic);
  EXPECT_FALSE(is_proven(coarse.certificate));
  EXPECT_FALSE(verify_mesh(coarse.mesh, grid, isovalue).proven);
}

// Stage 2 would measure all of the mesh again, and refine triangles that are near.
TEST(Deliso, AFewPlacesTooFarOffAreLeftToSteps) {
  const ScalarGrid grid = generate_field("shells", 40);
  MeshingOptions options;
  const MeshingResult far = mesh_isosurface(grid, 0.1, options);
  options.parameters.promise.max_distance = 0.3;
  const MeshingResult near = mesh_isosurface(grid, 0.1, options);
  EXPECT_FALSE(verify_mesh(far.mesh, grid, 0.1, {.max_distance = 0.3}).proven);
  EXPECT_TRUE(verify_mesh(near.mesh, grid, 0.1, {.max_distance = 0.3}).proven);
  EXPECT_EQ(near.refine.insertions, far.refine.insertions);
  EXPECT_GE(measure_quality(near.mesh).min_angle_degrees, 10);
}

TEST(Deliso, EqualRunsGiveEqualBytes) {
  for (const char* name : {"torus", "gyroid", "noise"}) {
    const std::int32_t size = std::string(name) == "noise" ? 6 : 16;
    const MeshingResult a = mesh_field(name, size);
    const MeshingResult b = mesh_field(name, size);
    EXPECT_EQ(a.mesh.points, b.mesh.points) << name;
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles) << name;
    EXPECT_GT(a.mesh.points.size(), 100u);
  }
}

TEST(Deliso, RandomSeedingFollowsTheSeed) {
  MeshingOptions options;
  options.parameters.initial.random_points = 20;
  options.parameters.initial.seeding = Seeding::kRandom;
  options.parameters.repair.max_rounds = 0;
  const MeshingResult a = mesh_field("torus", 16, options);
  const MeshingResult b = mesh_field("torus", 16, options);
  options.seed = 2;
  const MeshingResult c = mesh_field("torus", 16, options);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_NE(a.mesh.points, c.mesh.points);
  EXPECT_EQ(a.certificate.verdict, Verdict::kHomeomorphic);
  EXPECT_EQ(c.certificate.verdict, Verdict::kHomeomorphic);
}

TEST(Deliso, ClosedModeGivesClosedMeshes) {
  for (const char* name : {"gyroid", "plane", "sheets"}) {
    SCOPED_TRACE(name);
    MeshingOptions options;
    options.parameters.boundary = Boundary::kClosed;
    const MeshingResult result = mesh_field(name, 16, options);
    const auto facts = test::mesh_facts(result.mesh.triangles);
    EXPECT_EQ(facts.defect, "");
    EXPECT_TRUE(facts.boundary.empty());
    EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic);
  }
}

TEST(Deliso, Full3dGivesAProvenMeshToo) {
  MeshingOptions options;
  options.parameters.algorithm = Algorithm::kFull3d;
  const MeshingResult result = mesh_field("torus", 20, options);
  expect_proven(result, generate_field("torus", 20), find_analytic_field("torus").isovalue);
  EXPECT_EQ(result.refine.insertions, 0);
}

// The same samples elsewhere: the mesh is the same one moved.
TEST(Deliso, SpacingAndOriginOnlyMoveTheMesh) {
  const ScalarGrid grid = generate_field("torus", 20);
  const double isovalue = find_analytic_field("torus").isovalue;
  const MeshingResult base = mesh_isosurface(grid, isovalue, {});
  for (const auto& [spacing, origin] : std::vector<std::pair<double, Vec3>>{
           {1, {1e6, -1e6, 1e6}}, {1e-6, {0, 0, 0}}, {1e6, {3, 4, 5}}, {0.3, {-1, 2, 1e3}}}) {
    const ScalarGrid moved(grid.dims(), grid.samples(), {spacing, spacing, spacing}, origin);
    const MeshingResult result = mesh_isosurface(moved, isovalue, {});
    SCOPED_TRACE(spacing);
    expect_proven(result, moved, isovalue);
    ASSERT_EQ(result.mesh.triangles, base.mesh.triangles);
    for (std::size_t v = 0; v < base.mesh.points.size(); ++v) {
      const Vec3 expected = origin + spacing * base.mesh.points[v];
      EXPECT_LE(distance(result.mesh.points[v], expected), 1e-12 * (norm(expected) + norm(origin)));
    }
  }
}

TEST(Deliso, StretchedVolumesAreProven) {
  for (const Vec3& spacing : {Vec3{1, 1, 4}, Vec3{0.25, 1, 1}, Vec3{2, 0.5, 1}}) {
    const auto field = [&](double i, double j, double k) {
      return 6 - distance(scaled(spacing, {i, j, k}), {8.03, 8.01, 7.96});
    };
    Dims dims{};
    for (std::size_t axis = 0; axis < 3; ++axis) dims[axis] = static_cast<std::int32_t>(16 / spacing[axis]) + 1;
    const ScalarGrid grid = testing::sampled_grid<double>(dims, spacing, field);
    SCOPED_TRACE(spacing.x);
    expect_proven(mesh_isosurface(grid, 0, {}), grid, 0);
  }
}

TEST(Deliso, TheSmallestVolumesAreProven) {
  int proven = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    const Dims dims = seed < 20 ? Dims{2, 2, 2} : Dims{2, 2 + static_cast<std::int32_t>(seed % 3), 5};
    const ScalarGrid grid = testing::noise_grid(dims, {1, 1, 1}, rng);
    const auto [low, high] = grid.range();
    const MeshingResult result = mesh_isosurface(grid, 0.5 * (low + high) + 0.25, {});
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_valid(result, grid);
    proven += result.certificate.verdict == Verdict::kHomeomorphic ? 1 : 0;
  }
  EXPECT_EQ(proven, 40);
}

TEST(Deliso, NoiseIsProvenInBothBoundaryModes) {
  int proven = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const Boundary boundary : {Boundary::kOpen, Boundary::kClosed}) {
      MeshingOptions options;
      options.parameters.boundary = boundary;
      options.parameters.stage2.r_min = 0.1;
      Rng rng(seed);
      const ScalarGrid grid = testing::noise_grid({4, 5, 4}, {1, 1, 1}, rng);
      SCOPED_TRACE("seed " + std::to_string(seed));
      const MeshingResult result = mesh_isosurface(grid, 127.5, options);
      EXPECT_EQ(test::mesh_facts(result.mesh.triangles).defect, "");
      proven += result.certificate.verdict == Verdict::kHomeomorphic ? 1 : 0;
    }
  }
  EXPECT_EQ(proven, 12);
}

TEST(Deliso, SamplesEqualToTheIsovalueAndPlateausMoveTheIsovalue) {
  // A ball of integer samples with plateaus at every level, one of them asked for.
  const ScalarGrid grid =
      testing::sampled_grid<std::uint8_t>({12, 12, 12}, {1, 1, 1}, [](double i, double j, double k) {
        return std::max(
            0.0, 8 - std::round(std::sqrt((i - 5.5) * (i - 5.5) + (j - 5.5) * (j - 5.5) + (k - 5.5) * (k - 5.5))));
      });
  for (const double isovalue : {3.0, 4.0, 5.0}) {
    SCOPED_TRACE(isovalue);
    const MeshingResult result = mesh_isosurface(grid, isovalue, {});
    EXPECT_LT(result.isovalue_used, isovalue);
    EXPECT_GT(result.isovalue_used, isovalue - 1);
    expect_proven(result, grid, isovalue);
  }
}

TEST(Deliso, TheStopFlagAndBudgetsLeaveAValidPartialMesh) {
  const ScalarGrid grid = generate_field("gyroid", 16);
  const double isovalue = find_analytic_field("gyroid").isovalue;
  std::atomic<bool> stop = true;
  MeshingOptions options;
  options.stop = &stop;
  const MeshingResult stopped = mesh_isosurface(grid, isovalue, options);
  EXPECT_TRUE(stopped.stopped_early());
  expect_valid(stopped, grid);

  for (const std::int64_t vertices : {4, 300, 700}) {
    MeshingOptions limited;
    limited.parameters.budget.max_vertices = vertices;
    const MeshingResult result = mesh_isosurface(grid, isovalue, limited);
    EXPECT_TRUE(result.stopped_early()) << vertices;
    expect_valid(result, grid);
  }

  MeshingOptions hurried;
  hurried.parameters.budget.seconds = 1e-9;
  EXPECT_TRUE(mesh_isosurface(grid, isovalue, hurried).stopped_early());
}

// Noise needs much repair, and repair adds many points: none of it when the budget is spent before.
TEST(Deliso, ASpentBudgetLeavesNothingToRepair) {
  const ScalarGrid grid = generate_field("noise", 10);
  const double isovalue = find_analytic_field("noise").isovalue;
  MeshingOptions options;
  options.parameters.budget.max_vertices = 300;
  const MeshingResult result = mesh_isosurface(grid, isovalue, options);
  EXPECT_TRUE(result.stopped_early());
  EXPECT_EQ(result.repair.rounds, 0);
  EXPECT_EQ(result.repair.components_polygonized, 0);
  EXPECT_EQ(result.refine.insertions, 0);
}

TEST(Deliso, TheStage1MeshIsKeptWhenAskedFor) {
  MeshingOptions options;
  options.keep_stage1_mesh = true;
  options.parameters.shape.smoothing = 0;  // else its vertices move
  const MeshingResult result = mesh_field("torus", 16, options);
  ASSERT_TRUE(result.stage1_mesh.has_value());
  const TriangleMesh& stage1 = *result.stage1_mesh;
  EXPECT_LT(stage1.points.size(), result.mesh.points.size());
  EXPECT_TRUE(std::equal(stage1.points.begin(), stage1.points.end(), result.mesh.points.begin()));
  EXPECT_EQ(test::mesh_facts(stage1.triangles).components, (std::vector<ComponentTopology>{{0, 0}}));
  EXPECT_FALSE(mesh_field("torus", 16).stage1_mesh.has_value());
}

TEST(Deliso, ProgressNamesTheStagesInOrder) {
  std::vector<std::string> stages;
  MeshingOptions options;
  options.progress = [&](const Progress& p) {
    if (stages.empty() || stages.back() != p.stage) stages.emplace_back(p.stage);
  };
  mesh_field("torus", 20, options);
  const std::vector<std::string> order = {"index", "initial", "recover", "repair", "refine", "shape", "certify"};
  auto at = order.begin();
  for (const std::string& stage : stages) {
    at = std::find(at, order.end(), stage);
    ASSERT_NE(at, order.end()) << stage;
  }
  EXPECT_EQ(stages.front(), "index");
  EXPECT_EQ(stages.back(), "certify");
}

TEST(Deliso, IsovaluesWithoutASurfaceAreInputErrors) {
  const ScalarGrid grid = generate_field("torus", 12);
  const auto [low, high] = grid.range();
  for (const double isovalue :
       {low - 1, high + 1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(mesh_isosurface(grid, isovalue, {}), InputError) << isovalue;
  }
  const ScalarGrid constant({3, 3, 3}, std::vector<float>(27, 1.0f));
  EXPECT_THROW(mesh_isosurface(constant, 1, {}), InputError);
  EXPECT_THROW(mesh_isosurface(constant, 0.5, {}), InputError);
  MeshingOptions nothing;
  nothing.parameters.initial.seeding = Seeding::kRandom;
  EXPECT_THROW(mesh_isosurface(grid, 0.7, nothing), InputError);
}

}  // namespace
}  // namespace deliso
