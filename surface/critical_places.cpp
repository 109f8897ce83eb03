#include "surface/critical_places.h"

#include <bit>

#include "surface/blocks.h"
#include "volume/critical_points.h"

namespace deliso {

namespace {

// Appends the critical points of a cell, not yet located.
void append_places(const Isosurface& isosurface, const ScalarGrid& grid, const CellIndex& cell,
                   std::vector<CriticalPlace>& places) {
  const auto append = [&](const Vec3& uvw, bool is_above) {
    const Vec3 p{cell[0] + uvw.x, cell[1] + uvw.y, cell[2] + uvw.z};
    places.push_back({scaled(p, isosurface.step()), cell, TetId::none(), is_above});
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

CriticalPlaces::CriticalPlaces(const SignedDelaunay& restricted, const ScalarGrid& grid,
                               std::span<const CellIndex> cells, int threads)
    : restricted_(restricted) {
  places_ =
      collect_in_blocks<CriticalPlace>(cells.size(), threads, [&](std::size_t i, std::vector<CriticalPlace>& places) {
        const TetId first = restricted_.delaunay().incident_tet(VertexId(std::size_t{0}));
        TetId hint = places.empty() ? first : places.back().tet;
        const std::size_t known = places.size();
        append_places(restricted_.isosurface(), grid, cells[i], places);
        for (std::size_t at = known; at < places.size(); ++at) places[at].tet = hint = located(places[at], hint);
      });
}

void CriticalPlaces::renew(const ExchangedPoints& exchanged) {
  TetId hint = restricted_.delaunay().incident_tet(VertexId(std::size_t{0}));
  std::vector<bool> is_renewed(restricted_.delaunay().tet_slots(), false);
  for (const TetId t : exchanged.renewed) is_renewed[t.index()] = true;
  for (CriticalPlace& place : places_) {
    if (is_renewed[place.tet.index()]) place.tet = hint = located(place, hint);
  }
}

TetId CriticalPlaces::located(const CriticalPlace& place, TetId hint) const {
  const CellIndex& cell = place.cell;
  const Vec3 center = scaled({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}, restricted_.isosurface().step());
  return restricted_.locate(place.point, center, hint);
}

}  // namespace deliso
