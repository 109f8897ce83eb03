// Facts of the surface, and what repair makes of them: found before or when asked for, on any number of threads.
#include "surface/surface_facts.h"

#include <gtest/gtest.h>

#include "surface/repair_round.h"
#include "surface/trouble.h"
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

// The mesh of a start with few points has trouble in many places; the cells come in the same order.
TEST(CellsInTrouble, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({30, 29, 28}, 6);
  const RaisedCells raised(scene->grid, *scene->isosurface);
  RepairRound round(scene->grid, scene->topology, raised,
                    std::make_unique<SignedDelaunay>(*scene->isosurface, scene->start()), 1);
  round.take_plain_signs();
  const MatchedMesh mesh = round.assemble().value();
  const std::vector<bool> done(scene->topology.components.size(), false);
  const SurfaceFacts facts(scene->grid, *scene->isosurface, scene->topology, 1);
  ASSERT_GT(facts.critical_cells().size(), 3 * 4096u);  // several blocks
  const auto cells = [&](int threads) {
    return cells_in_trouble(
        {scene->grid, scene->topology, round.restricted(), mesh, raised, round.component_of_vertex(), done,
         std::vector<Places>(done.size()), facts.critical_cells(), round.evidence()},
        threads);
  };
  const std::vector<CellName> one = cells(1);
  EXPECT_GT(one.size(), 1000u);
  for (const int threads : {2, 3, 5}) EXPECT_EQ(cells(threads), one) << threads;
}

}  // namespace
}  // namespace deliso
