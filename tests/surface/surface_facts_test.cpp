// Facts of the surface, and what repair makes of them: found before or when asked for, on any number of threads.
#include "surface/surface_facts.h"

#include <gtest/gtest.h>

#include "surface/blocks.h"
#include "surface/critical_places.h"
#include "tests/support/surface_fields.h"
#include "volume/critical_points.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// Cell by cell, from the samples.
std::vector<CellIndex> critical_cells_by_search(const Scene& scene) {
  std::vector<CellIndex> cells;
  const Dims& dims = scene.grid.dims();
  for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
        const CellCorners corners = scene.grid.cell(i, j, k);
        const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
        if (*low > scene.isovalue || *high < scene.isovalue) continue;
        std::vector<CriticalPoint> saddles;
        append_critical_points(corners, saddles);
        if (!saddles.empty() || critical_corners(scene.grid, {i, j, k}) != 0) cells.push_back({i, j, k});
      }
    }
  }
  return cells;
}

TEST(SurfaceFacts, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const std::vector<CellIndex> cells = critical_cells_by_search(*scene);
  ASSERT_GT(cells.size(), 100u);
  const PolygonizedSurface surface = polygonized_surface(scene->grid, *scene->isosurface, scene->topology);
  for (const int threads : {1, 2, 3, 5}) {
    const SurfaceFacts facts(scene->grid, *scene->isosurface, scene->topology, threads);
    EXPECT_EQ(facts.polygonized().mesh.points, surface.mesh.points) << threads;
    EXPECT_EQ(facts.polygonized().mesh.triangles, surface.mesh.triangles) << threads;
    EXPECT_EQ(facts.polygonized().component, surface.component) << threads;
    EXPECT_EQ(facts.critical_cells(), cells) << threads;
  }
}

TEST(SurfaceFacts, NobodyHasToAsk) {
  const auto scene = field_scene("gyroid", 32);
  for (int i = 0; i < 20; ++i) SurfaceFacts(scene->grid, *scene->isosurface, scene->topology, 2);
}

TEST(CriticalPlaces, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({40, 39, 38}, 6);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const SurfaceFacts facts(scene->grid, *scene->isosurface, scene->topology, 1);
  ASSERT_GT(facts.critical_cells().size(), 2 * kBlockSize);
  const CriticalPlaces one(restricted, scene->grid, facts.critical_cells(), 1);
  for (const int threads : {2, 3, 5}) {
    const CriticalPlaces many(restricted, scene->grid, facts.critical_cells(), threads);
    ASSERT_EQ(many.places().size(), one.places().size());
    for (std::size_t i = 0; i < one.places().size(); ++i) {
      ASSERT_EQ(many.places()[i].point, one.places()[i].point) << threads;
      ASSERT_EQ(many.places()[i].cell, one.places()[i].cell) << threads;
      ASSERT_EQ(many.places()[i].tet, one.places()[i].tet) << threads;
      ASSERT_EQ(many.places()[i].is_above, one.places()[i].is_above) << threads;
    }
  }
}

}  // namespace
}  // namespace deliso
