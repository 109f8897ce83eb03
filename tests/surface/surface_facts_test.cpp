// Facts of the surface, and what repair makes of them: found before or when asked for, on any number of threads.
#include "surface/surface_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "surface/blocks.h"
#include "surface/critical_places.h"
#include "tests/support/surface_fields.h"
#include "volume/critical_points.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// Cell by cell, from the samples: (cell, how many critical places).
std::vector<std::pair<CellIndex, std::size_t>> critical_cells_by_search(const Scene& scene) {
  std::vector<std::pair<CellIndex, std::size_t>> cells;
  const Dims& dims = scene.grid.dims();
  for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
        const CellCorners corners = scene.grid.cell(i, j, k);
        const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
        if (*low > scene.isovalue || *high < scene.isovalue) continue;
        std::vector<CriticalPoint> saddles;
        append_critical_points(corners, saddles);
        const auto count =
            static_cast<std::size_t>(std::count_if(saddles.begin(), saddles.end(),
                                                   [&](const CriticalPoint& saddle) {
                                                     return side_of_saddle(corners, scene.isovalue, saddle) != 0;
                                                   }) +
                                     std::popcount(critical_corners(scene.grid, {i, j, k})));
        if (count > 0) cells.push_back({{i, j, k}, count});
      }
    }
  }
  return cells;
}

std::vector<std::pair<CellIndex, std::size_t>> cells_of(const std::vector<CriticalPlace>& places) {
  std::vector<std::pair<CellIndex, std::size_t>> cells;
  for (const CriticalPlace& place : places) {
    if (cells.empty() || cells.back().first != place.cell) cells.push_back({place.cell, 0});
    ++cells.back().second;
  }
  return cells;
}

TEST(SurfaceFacts, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const auto cells = critical_cells_by_search(*scene);
  ASSERT_GT(cells.size(), 100u);
  const PolygonizedSurface surface = polygonized_surface(scene->grid, *scene->isosurface, scene->topology);
  for (const int threads : {1, 2, 3, 5}) {
    const SurfaceFacts facts(scene->grid, *scene->isosurface, scene->topology, threads);
    EXPECT_EQ(facts.polygonized().mesh.points, surface.mesh.points) << threads;
    EXPECT_EQ(facts.polygonized().mesh.triangles, surface.mesh.triangles) << threads;
    EXPECT_EQ(facts.polygonized().component, surface.component) << threads;
    EXPECT_EQ(cells_of(facts.critical_places()), cells) << threads;
  }
}

TEST(SurfaceFacts, NobodyHasToAsk) {
  const auto scene = field_scene("gyroid", 32);
  for (int i = 0; i < 20; ++i) SurfaceFacts(scene->grid, *scene->isosurface, scene->topology, 2);
}

// All at once on several threads, or a few at a time.
TEST(LocatedPlaces, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({40, 39, 38}, 6);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const SurfaceFacts facts(scene->grid, *scene->isosurface, scene->topology, 1);
  const std::vector<CriticalPlace>& places = facts.critical_places();
  ASSERT_GT(places.size(), 2 * kBlockSize);
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  LocatedPlaces one(restricted, places);
  one.locate(all, 1);
  LocatedPlaces few(restricted, places);
  for (std::size_t i = 0; i < all.size(); i += 100) few.locate(std::span(all).subspan(i, 1), 1);
  for (std::uint32_t i = 0; i < places.size(); i += 100) {
    ASSERT_FALSE(few.tet(i).is_none());
    if (restricted.delaunay().is_ghost(one.tet(i))) continue;
    ASSERT_EQ(few.tet(i), one.tet(i));
  }
  for (const int threads : {2, 3, 5}) {
    LocatedPlaces many(restricted, places);
    many.locate(all, threads);
    for (const std::uint32_t i : all) ASSERT_EQ(many.tet(i), one.tet(i)) << threads;
  }
}

}  // namespace
}  // namespace deliso
