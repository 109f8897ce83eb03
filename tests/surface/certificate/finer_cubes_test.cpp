#include "surface/certificate/finer_cubes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "surface/certificate/certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/intersection/self_intersection.h"
#include "surface/repair/lattice/cell_pieces.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// Component by component, in flat cells, too: right in topology, as near as asked for, and apart from each other.
TEST(FinerCubes, KeepAllThatIsPromised) {
  for (const double flat : {1.0, 0.15}) {
    Rng rng(5);
    const testing::Scene scene("noise", testing::noise_grid({6, 5, 5}, {1, flat, 1}, rng), 127.5);
    const std::size_t count = scene.topology.components.size();
    SurfaceMesh mesh;
    for (std::size_t c = 0; c < count; ++c) {
      std::vector<bool> one(count, false);
      one[c] = true;
      const ExactPolygonization cubes = finer_cubes(one, scene.surface(), factors_within(0.5, *scene.isosurface));
      ASSERT_FALSE(cubes.component.empty()) << c;
      append_pieces(cubes.mesh, cubes.component, one, mesh);
    }
    const Promise promise{.max_distance = 0.5};
    const GeometryCheck check = check_geometry(mesh, scene.surface(), promise);
    EXPECT_TRUE(check.is_near());
    EXPECT_EQ(check.vertices_off, 0);
    EXPECT_EQ(check.reversed_components, 0);
    EXPECT_TRUE(check.off_box_edges.empty());
    const Verification verification =
        verify_mesh(to_world(mesh, *scene.isosurface), scene.grid, scene.isovalue, promise);
    EXPECT_TRUE(verification.proven);
    for (const std::string& failure : verification.failures) ADD_FAILURE() << failure;
  }
}

// Some means of two samples are the isovalue: another factor is taken.
TEST(FinerCubes, PassOverSamplesThatEqualTheIsovalue) {
  Rng rng(6);
  const testing::Scene scene("noise", testing::noise_grid({7, 7, 7}, {1, 1, 1}, rng), 127.5);
  bool has_mean = false;
  for (std::int32_t i = 0; i + 1 < 7; ++i) {
    for (std::int32_t jk = 0; jk < 49; ++jk) {
      has_mean = has_mean || scene.grid.at(i, jk % 7, jk / 7) + scene.grid.at(i + 1, jk % 7, jk / 7) == 255;
    }
  }
  ASSERT_TRUE(has_mean);
  const std::vector<bool> all(scene.topology.components.size(), true);
  const ExactPolygonization cubes = finer_cubes(all, scene.surface(), factors_within(1, *scene.isosurface));
  EXPECT_EQ(certify(to_world(cubes.mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic);
}

double longest_edge(const SurfaceMesh& mesh) {
  double longest = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      longest = std::max(longest, std::sqrt(squared_distance(mesh.points[p], mesh.points[q])));
    }
  }
  return longest;
}

// In cells of 1:1:6 no edge is as long as a cell.
TEST(FinerCubes, HaveNoNeedlesInFlatCells) {
  Rng rng(7);
  const testing::Scene scene("noise", testing::noise_grid({9, 9, 9}, {1, 1, 6}, rng), 60.5);
  const GridFactors factors = cell_pieces(*scene.isosurface);
  EXPECT_EQ(factors, (GridFactors{1, 1, 5}));
  const std::size_t count = scene.topology.components.size();
  ASSERT_GT(count, 2u);
  const ExactPolygonization cubes = finer_cubes(std::vector<bool>(count, true), scene.surface(), factors);
  EXPECT_LT(longest_edge(cubes.mesh), 3);
  EXPECT_GT(longest_edge(exact_polygonization(scene.surface()).mesh), 6);
  EXPECT_EQ(certify(to_world(cubes.mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic);
  EXPECT_EQ(self_intersections(cubes.mesh.points, cubes.mesh.triangles).crossing_pairs, 0);
  EXPECT_EQ(cubes.component.size(), cubes.mesh.points.size());
  for (std::size_t v = 0; v < cubes.component.size(); ++v) {
    EXPECT_EQ(scene.surface().component_at(cubes.mesh.points[v]), cubes.component[v]);
  }
}

TEST(FinerCubes, WithFactorsOfOneAreTheCubesThemselves) {
  Rng rng(9);
  const testing::Scene scene("noise", testing::noise_grid({6, 6, 6}, {1, 1, 1}, rng), 127.5);
  const std::vector<bool> all(scene.topology.components.size(), true);
  const ExactPolygonization cubes = finer_cubes(all, scene.surface(), factors_within(3, *scene.isosurface));
  EXPECT_EQ(cubes.mesh.triangles.size(), exact_polygonization(scene.surface()).mesh.triangles.size());
}

TEST(FinerCubes, OfAMaskInFlatCellsAreAllThere) {
  Rng rng(8);
  const auto bit = [&](const Vec3&) { return static_cast<double>(rng.below(2)); };
  const testing::Scene scene("mask", testing::sampled({8, 8, 8}, bit, {1, 1, 4}), 0.499);
  const std::vector<bool> all(scene.topology.components.size(), true);
  const ExactPolygonization cubes = finer_cubes(all, scene.surface(), cell_pieces(*scene.isosurface));
  EXPECT_EQ(certify(to_world(cubes.mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic);
  EXPECT_EQ(self_intersections(cubes.mesh.points, cubes.mesh.triangles).crossing_pairs, 0);
}

}  // namespace
}  // namespace deliso
