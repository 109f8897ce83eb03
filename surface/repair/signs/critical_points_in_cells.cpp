#include "surface/repair/signs/critical_points_in_cells.h"

#include <bit>

#include "surface/base/parallel_blocks.h"
#include "volume/topology/critical_points.h"

namespace deliso {

namespace {

// The number of points that a thread locates at a time.
constexpr std::size_t kPointsAtOnce = 4096;

void append_points(const Isosurface& isosurface, const CellIndex& cell, std::uint32_t number,
                   std::vector<CriticalPointInCell>& points) {
  const ScalarGrid& grid = isosurface.grid();
  const auto append = [&](const Vec3& uvw, bool is_above) {
    const Vec3 p{cell[0] + uvw.x, cell[1] + uvw.y, cell[2] + uvw.z};
    points.push_back({scaled(p, isosurface.step()), number, is_above});
  };
  const CellCorners corners = grid.cell(cell[0], cell[1], cell[2]);
  std::vector<CriticalPoint> saddles;
  append_critical_points(corners, saddles);
  for (const CriticalPoint& saddle : saddles) {
    const int side = side_of_saddle(corners, isosurface.isovalue(), saddle);
    if (side != 0) append(saddle.uvw, side > 0);
  }
  for (unsigned critical = critical_corners(grid, cell); critical != 0; critical &= critical - 1) {
    const auto corner = static_cast<unsigned>(std::countr_zero(critical));
    append({static_cast<double>(corner & 1u), static_cast<double>(corner >> 1 & 1u), static_cast<double>(corner >> 2)},
           corners[corner] > isosurface.isovalue());
  }
}

}  // namespace

std::vector<CriticalPointInCell> critical_points_in(std::span<const CellIndex> cells, const Isosurface& isosurface,
                                                    int threads) {
  return collect_in_blocks<CriticalPointInCell>(
      cells.size(), threads, [&](std::size_t i, std::vector<CriticalPointInCell>& points) {
        append_points(isosurface, cells[i], static_cast<std::uint32_t>(i), points);
      });
}

std::vector<TetId> tets_at(std::span<const CriticalPointInCell> points, std::span<const CellIndex> cells,
                           const SignedDelaunay& restricted, int threads) {
  std::vector<TetId> tets(points.size());
  const auto locate = [&](std::size_t first, std::size_t last) {
    TetId hint = restricted.delaunay().incident_tet(VertexId(std::size_t{0}));
    for (std::size_t i = first; i < last; ++i) {
      const CellIndex& cell = cells[points[i].cell];
      const Vec3 center = scaled({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}, restricted.isosurface().step());
      tets[i] = hint = restricted.locate(points[i].point, center, hint);
    }
  };
  for_each_block(points.size(), threads, locate, kPointsAtOnce);
  return tets;
}

}  // namespace deliso
