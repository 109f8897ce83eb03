// Data of the surface and located critical points: computed in advance or on request, on any number of threads.
#include "surface/repair/diagnosis/exact_surface_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "surface/base/parallel_blocks.h"
#include "surface/repair/signs/located_critical_points.h"
#include "tests/support/surface_fields.h"
#include "volume/topology/critical_points.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// Cell by cell, from the samples: (cell, number of critical points).
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

std::vector<std::pair<CellIndex, std::size_t>> cells_of(const std::vector<LocatedCriticalPoint>& points) {
  std::vector<std::pair<CellIndex, std::size_t>> cells;
  for (const LocatedCriticalPoint& place : points) {
    if (cells.empty() || cells.back().first != place.cell) cells.push_back({place.cell, 0});
    ++cells.back().second;
  }
  return cells;
}

TEST(ExactSurfaceCache, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const ExactPolygonization surface = exact_polygonization(scene->surface());
  const ExactEulerCurves curves(scene->surface());
  for (const int threads : {1, 2, 3, 5}) {
    const ExactSurfaceCache cache(scene->surface(threads));
    EXPECT_EQ(cache.polygonized().mesh.points, surface.mesh.points) << threads;
    EXPECT_EQ(cache.polygonized().mesh.triangles, surface.mesh.triangles) << threads;
    EXPECT_EQ(cache.polygonized().component, surface.component) << threads;
    for (std::uint32_t c = 0; c < scene->topology.components.size(); ++c) {
      EXPECT_EQ(cache.euler_curves().of(c), curves.of(c)) << threads;
    }
  }
}

TEST(ExactSurfaceCache, IsDestroyedWithoutRequests) {
  const auto scene = field_scene("gyroid", 32);
  for (int i = 0; i < 20; ++i) ExactSurfaceCache(scene->surface(2));
}

std::vector<CellIndex> active_cells(const Scene& scene) {
  std::vector<CellIndex> cells;
  scene.topology.index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t) { cells.push_back(cell); });
  return cells;
}

TEST(LocatedCriticalPoints, AreFoundInTheCellsAskedFor) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const auto expected = critical_cells_by_search(*scene);
  ASSERT_GT(expected.size(), 100u);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const std::vector<CellIndex> cells = active_cells(*scene);
  for (const int threads : {1, 3}) {
    LocatedCriticalPoints points(restricted);
    points.find(cells, threads);
    EXPECT_EQ(cells_of(points.points()), expected) << threads;
  }
  // Some cells, then others, then all, so that many cells are requested twice.
  LocatedCriticalPoints points(restricted);
  for (const std::size_t step : {7u, 3u}) {
    std::vector<CellIndex> some;
    for (std::size_t i = step / 2; i < cells.size(); i += step) some.push_back(cells[i]);
    points.find(some, 1);
    EXPECT_LT(cells_of(points.points()).size(), expected.size());
  }
  points.find(cells, 1);
  EXPECT_EQ(cells_of(points.points()), expected);
}

TEST(LocatedCriticalPoints, KeepTheirTetrahedraWhenMoreAreFound) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const std::vector<CellIndex> cells = active_cells(*scene);
  LocatedCriticalPoints points(restricted);
  points.find(std::span(cells).subspan(cells.size() / 2), 1);
  const std::size_t count = points.points().size();
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  points.locate(all, 1);
  std::vector<TetId> tets;
  for (const std::uint32_t i : all) tets.push_back(points.tet(i));
  points.find(cells, 1);
  const std::size_t before = points.points().size() - count;
  ASSERT_GT(before, 0u);
  for (std::uint32_t i = 0; i < before; ++i) ASSERT_TRUE(points.tet(i).is_none());
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(points.tet(static_cast<std::uint32_t>(before + i)), tets[i]);
}

// All at once on several threads, or a few at a time.
TEST(LocatedCriticalPoints, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({40, 39, 38}, 6);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const std::vector<CellIndex> cells = active_cells(*scene);
  LocatedCriticalPoints one(restricted);
  one.find(cells, 1);
  const std::size_t count = one.points().size();
  ASSERT_GT(count, 2 * kBlockSize);
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  one.locate(all, 1);
  LocatedCriticalPoints few(restricted);
  few.find(cells, 1);
  for (std::size_t i = 0; i < all.size(); i += 100) few.locate(std::span(all).subspan(i, 1), 1);
  for (std::uint32_t i = 0; i < count; i += 100) {
    ASSERT_FALSE(few.tet(i).is_none());
    if (restricted.delaunay().is_ghost(one.tet(i))) continue;
    ASSERT_EQ(few.tet(i), one.tet(i));
  }
  for (const int threads : {2, 3, 5}) {
    LocatedCriticalPoints many(restricted);
    many.find(cells, threads);
    many.locate(all, threads);
    for (const std::uint32_t i : all) ASSERT_EQ(many.tet(i), one.tet(i)) << threads;
  }
}

}  // namespace
}  // namespace deliso
