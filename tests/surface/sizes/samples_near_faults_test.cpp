// Samples for a second time of stage 1, and meshes that need one.
#include "surface/sizes/samples_near_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"
#include "volume/io/volume_file.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

// A triangle of which a sample is too far, and a crossing that is missed, on a ball.
class SamplesNearFaults : public ::testing::Test {
 protected:
  SamplesNearFaults() {
    mesh_.points = {{3.2, 4.1, 5.3}, {4.7, 4.2, 5.1}, {4.1, 5.6, 5.2}};
    mesh_.triangles = {{0, 1, 2}};
    check_.far_triangles = {0};
    check_.missed_points = {{6, 9.6, 6}};
    cells_.add(mesh_, check_);
  }

  ScalarGrid grid_ = testing::sampled({13, 13, 13}, testing::ball_field({6, 6, 6}, 3.6));
  Isosurface isosurface_{grid_, 0.01, SearchOptions{}};
  SurfaceMesh mesh_;
  GeometryCheck check_;
  CellsNearFaults cells_{isosurface_};
};

TEST_F(SamplesNearFaults, LieOnTheIsosurfaceThere) {
  const std::vector<Vec3> samples = cells_.samples(0.25);
  EXPECT_GT(samples.size(), 100u);
  for (const Vec3& p : samples) {
    EXPECT_NEAR(isosurface_.value(p), 0, 1e-9);
    const bool near_triangle = p.x >= 2 && p.x <= 6 && p.y >= 3 && p.y <= 7 && p.z >= 4 && p.z <= 6;
    const bool near_crossing = p.x >= 5 && p.x <= 7 && p.y >= 9 && p.y <= 11 && p.z >= 5 && p.z <= 7;
    EXPECT_TRUE(near_triangle || near_crossing) << p.x << " " << p.y << " " << p.z;
  }
  EXPECT_GT(cells_.samples(0.125).size(), 3 * samples.size());
}

TEST_F(SamplesNearFaults, HoldTheCrossingsOfGridEdges) {
  const std::vector<Vec3> samples = cells_.samples(1);
  const IsosurfaceTopology topology = exact_topology(grid_, 0.01, 1);
  const ExactSurface surface{isosurface_, topology, 1};
  int inside = 0;
  for (const EdgeCrossing& crossing : topology.crossings) {
    const Vec3 p = surface.position(crossing);
    if (!(p.x >= 2 && p.x < 6 && p.y >= 3 && p.y < 7 && p.z >= 4 && p.z < 6)) continue;
    ++inside;
    EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [&](const Vec3& q) { return distance(p, q) < 1e-9; }));
  }
  EXPECT_GT(inside, 5);
}

// Webs and tips that neither stage 2 nor single steps reach: all of a component came from finer cubes.
TEST(Sizes, StageOneRunsAgainWhereAnErrorIsNotReached) {
  for (const auto& [name, isovalue] :
       {std::pair{"stated_error_2.nrrd", 160.63931460209872}, std::pair{"stated_error_3.nrrd", 160.39228540724568}}) {
    const ScalarGrid grid = read_volume(std::filesystem::path(DELISO_SOURCE_DIR) / "tests" / "regression" / name);
    MeshingOptions options;
    options.parameters.size.max_error = 0.1;
    const MeshingResult result = mesh_isosurface(grid, isovalue, options);
    EXPECT_TRUE(is_proven(result.certificate)) << name;
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used, {.max_distance = 0.1}).proven) << name;
    EXPECT_EQ(result.repair.components_polygonized, 0) << name;
    options.threads = 3;
    EXPECT_EQ(mesh_isosurface(grid, isovalue, options).mesh.points, result.mesh.points) << name;
  }
}

// Cubes four times as large as the error left more samples too far than they replaced: no smaller ones were tried, and
// no steps. Since stage 1 keeps its samples the field needs no cubes any more; if it does, they are no smaller than
// needed.
TEST(Sizes, NoiseIsProvenWithFewCubes) {
  const ScalarGrid grid =
      read_volume(std::filesystem::path(DELISO_SOURCE_DIR) / "tests" / "regression" / "stated_error_4.nrrd");
  MeshingOptions options;
  options.parameters.size.max_error = 0.1;
  const MeshingResult result = mesh_isosurface(grid, 127.5, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used, {.max_distance = 0.1}).proven);
  EXPECT_LE(result.repair.components_polygonized, 1);
  EXPECT_LT(result.decimation.vertices_before, 30'000);
}

// Refinement to a number of vertices after that once read coverage targets of the first time, which were gone.
TEST(Sizes, ANumberIsReachedAfterStageOneHasRunAgain) {
  const ScalarGrid grid =
      read_volume(std::filesystem::path(DELISO_SOURCE_DIR) / "tests" / "regression" / "stated_error_3.nrrd");
  MeshingOptions options;
  options.parameters.size.max_error = 0.1;
  options.parameters.size.target_vertices = 3000;
  const MeshingResult result = mesh_isosurface(grid, 160.39228540724568, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_NEAR(static_cast<double>(result.mesh.points.size()), 3000, 60);
}

}  // namespace
}  // namespace deliso
