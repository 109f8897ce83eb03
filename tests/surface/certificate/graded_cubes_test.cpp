#include "surface/certificate/graded_cubes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/certificate/certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/intersection/self_intersection.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

std::vector<CellIndex> random_cells(const Dims& dims, std::uint64_t percent, Rng& rng) {
  std::vector<CellIndex> cells;
  for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
        if (rng.below(100) < percent) cells.push_back({i, j, k});
      }
    }
  }
  return cells;
}

// Chains and fans fit together wherever divided cells end: a manifold with the exact topology, its boundary on the box,
// all vertices but a few inner ones on the isosurface.
TEST(GradedCubes, HaveTheExactTopologyWhicheverCellsAreDivided) {
  Rng rng(3);
  for (const GridFactors& factors : {GridFactors{3, 3, 3}, GridFactors{1, 2, 5}}) {
    for (const std::uint64_t percent : {0u, 10u, 50u, 90u, 100u}) {
      const testing::Scene scene("noise", testing::noise_grid({9, 8, 7}, {1, 1, 1}, rng), 127.37);
      const auto cubes = graded_cubes(scene.surface(), random_cells({9, 8, 7}, percent, rng), factors);
      ASSERT_TRUE(cubes) << percent;
      ASSERT_EQ(cubes->component.size(), cubes->mesh.points.size());
      EXPECT_EQ(certify(to_world(cubes->mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic)
          << percent;
      const GeometryCheck check = check_geometry(cubes->mesh, scene.surface(), Promise());
      EXPECT_TRUE(check.off_box_edges.empty()) << percent;
      EXPECT_EQ(check.reversed_components, 0) << percent;
      EXPECT_LE(check.vertices_off * 100, std::ssize(cubes->mesh.points)) << percent;
      for (std::uint32_t v = 0; v < cubes->mesh.points.size(); v += 7) {
        EXPECT_EQ(scene.surface().component_at(cubes->mesh.points[v]), cubes->component[v]);
      }
    }
  }
}

TEST(GradedCubes, OfNoCellsAreMarchingCubesAndOfAllCellsDoNotCross) {
  Rng rng(4);
  const testing::Scene scene("noise", testing::noise_grid({8, 8, 8}, {1, 1, 1}, rng), 127.37);
  const ExactPolygonization cubes = exact_polygonization(scene.surface());
  const auto none = graded_cubes(scene.surface(), {}, {2, 2, 2});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->mesh.points, cubes.mesh.points);
  EXPECT_EQ(none->mesh.triangles, cubes.mesh.triangles);
  const auto all = graded_cubes(scene.surface(), random_cells({8, 8, 8}, 100, rng), {2, 2, 2});
  ASSERT_TRUE(all);
  EXPECT_GT(all->mesh.points.size(), 3 * cubes.mesh.points.size());
  EXPECT_EQ(self_intersections(all->mesh.points, all->mesh.triangles).crossing_pairs, 0);
}

// The mean of two samples is the isovalue: halves do not do, thirds do.
TEST(GradedCubes, AreRefusedWhereASampleWouldEqualTheIsovalue) {
  const testing::Scene scene("step", {{2, 2, 2}, std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1, 0, 1}}, 0.5);
  EXPECT_FALSE(graded_cubes(scene.surface(), {{0, 0, 0}}, {2, 2, 2}));
  const auto thirds = graded_cubes(scene.surface(), {{0, 0, 0}}, {3, 3, 3});
  ASSERT_TRUE(thirds);
  EXPECT_EQ(thirds->mesh.points.size(), 16u);
}

}  // namespace
}  // namespace deliso
