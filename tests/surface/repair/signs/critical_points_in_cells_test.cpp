// Saddles and critical samples of cells, and their tetrahedra.
#include "surface/repair/signs/critical_points_in_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "surface/base/parallel_blocks.h"
#include "tests/support/surface_fields.h"
#include "volume/topology/critical_points.h"

namespace deliso {
namespace {

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

std::vector<CellIndex> active_cells(const Scene& scene) {
  std::vector<CellIndex> cells;
  scene.topology.index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t) { cells.push_back(cell); });
  return cells;
}

TEST(CriticalPointsInCells, AreThoseOfEachCell) {
  const auto scene = testing::noise_scene({14, 13, 12}, 4);
  const auto expected = critical_cells_by_search(*scene);
  ASSERT_GT(expected.size(), 100u);
  const std::vector<CellIndex> cells = active_cells(*scene);
  std::vector<std::pair<CellIndex, std::size_t>> found;
  for (const CriticalPointInCell& point : critical_points_in(cells, *scene->isosurface, 1)) {
    if (found.empty() || found.back().first != cells[point.cell]) found.push_back({cells[point.cell], 0});
    ++found.back().second;
  }
  EXPECT_EQ(found, expected);
}

TEST(CriticalPointsInCells, AreTheSameForAnyNumberOfThreads) {
  const auto scene = testing::noise_scene({40, 39, 38}, 6);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const std::vector<CellIndex> cells = active_cells(*scene);
  const std::vector<CriticalPointInCell> points = critical_points_in(cells, *scene->isosurface, 1);
  ASSERT_GT(points.size(), 2 * kBlockSize);
  const std::vector<TetId> tets = tets_at(points, cells, restricted, 1);
  for (const int threads : {2, 3, 5}) {
    const std::vector<CriticalPointInCell> again = critical_points_in(cells, *scene->isosurface, threads);
    ASSERT_EQ(again.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(again[i].point, points[i].point);
    EXPECT_EQ(tets_at(points, cells, restricted, threads), tets);
  }
  // Whatever was located before; among several ghosts it may be any.
  for (std::size_t i = 0; i < points.size(); i += 100) {
    if (restricted.delaunay().is_ghost(tets[i])) continue;
    ASSERT_EQ(tets_at(std::span(points).subspan(i, 1), cells, restricted, 1).front(), tets[i]);
  }
}

}  // namespace
}  // namespace deliso
