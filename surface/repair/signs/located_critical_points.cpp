#include "surface/repair/signs/located_critical_points.h"

#include <bit>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "volume/topology/critical_points.h"

namespace deliso {

namespace {

// The number of points that a thread locates at a time.
constexpr std::size_t kPointsAtOnce = 4096;

void append_points(const Isosurface& isosurface, const CellIndex& cell, std::vector<LocatedCriticalPoint>& points) {
  const ScalarGrid& grid = isosurface.grid();
  const auto append = [&](const Vec3& uvw, bool is_above) {
    const Vec3 p{cell[0] + uvw.x, cell[1] + uvw.y, cell[2] + uvw.z};
    points.push_back({scaled(p, isosurface.step()), cell, is_above});
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

void LocatedCriticalPoints::find(std::span<const CellIndex> cells, int threads) {
  // Cells whose points are known are skipped; cells without points are searched again.
  std::vector<CellIndex> asked;
  auto known = points_.begin();
  for (const CellIndex& cell : cells) {
    while (known != points_.end() && is_before(known->cell, cell)) ++known;
    if (known == points_.end() || known->cell != cell) asked.push_back(cell);
  }
  const Isosurface& isosurface = restricted_.isosurface();
  add(collect_in_blocks<LocatedCriticalPoint>(
      asked.size(), threads,
      [&](std::size_t i, std::vector<LocatedCriticalPoint>& points) { append_points(isosurface, asked[i], points); }));
}

// Merges the points of cells that had none before.
void LocatedCriticalPoints::add(const std::vector<LocatedCriticalPoint>& found) {
  std::vector<LocatedCriticalPoint> points;
  std::vector<TetId> tets;
  std::vector<std::uint8_t> is_located;
  points.reserve(points_.size() + found.size());
  tets.reserve(points.capacity());
  is_located.reserve(points.capacity());
  auto next = found.begin();
  for (std::size_t i = 0; i <= points_.size(); ++i) {
    for (; next != found.end() && (i == points_.size() || is_before(next->cell, points_[i].cell)); ++next) {
      points.push_back(*next);
      tets.push_back(TetId::none());
      is_located.push_back(0);
    }
    if (i == points_.size()) break;
    points.push_back(points_[i]);
    tets.push_back(tets_[i]);
    is_located.push_back(is_located_[i]);
  }
  points_ = std::move(points);
  tets_ = std::move(tets);
  is_located_ = std::move(is_located);
}

void LocatedCriticalPoints::renew(const ExchangedPoints& exchanged) {
  std::vector<bool> is_renewed(restricted_.delaunay().tet_slots(), false);
  for (const TetId t : exchanged.renewed) is_renewed[t.index()] = true;
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    if (is_located_[i] != 0 && is_renewed[tets_[i].index()]) is_located_[i] = 0;
  }
}

void LocatedCriticalPoints::locate(std::span<const std::uint32_t> wanted, int threads) {
  for_each_block(
      wanted.size(), threads,
      [&](std::size_t first, std::size_t last) {
        TetId hint = restricted_.delaunay().incident_tet(VertexId(std::size_t{0}));
        for (const std::uint32_t i : wanted.subspan(first, last - first)) {
          if (is_located_[i] == 0) {
            // What has taken the place of its tetrahedron is near it.
            const TetId before = tets_[i];
            if (!before.is_none() && restricted_.delaunay().is_live(before)) hint = before;
            tets_[i] = located(points_[i], hint);
            is_located_[i] = 1;
          }
          hint = tets_[i];
        }
      },
      kPointsAtOnce);
}

TetId LocatedCriticalPoints::located(const LocatedCriticalPoint& place, TetId hint) const {
  const CellIndex& cell = place.cell;
  const Vec3 center = scaled({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}, restricted_.isosurface().step());
  return restricted_.locate(place.point, center, hint);
}

}  // namespace deliso
