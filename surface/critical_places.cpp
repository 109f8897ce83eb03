#include "surface/critical_places.h"

#include <bit>

#include "volume/critical_points.h"

namespace deliso {

CriticalPlaces::CriticalPlaces(const SignedDelaunay& restricted, const ScalarGrid& grid,
                               const IsosurfaceTopology& topology)
    : restricted_(restricted), hint_(restricted.delaunay().incident_tet(VertexId(std::size_t{0}))) {
  const Isosurface& isosurface = restricted.isosurface();
  std::vector<CriticalPoint> saddles;
  topology.index.for_each_active_cell([&](const CellIndex& cell, unsigned) {
    const auto append = [&](const Vec3& uvw, bool is_above) {
      const Vec3 p{cell[0] + uvw.x, cell[1] + uvw.y, cell[2] + uvw.z};
      places_.push_back({scaled(p, isosurface.step()), cell, TetId::none(), is_above});
      locate(places_.back());
    };
    const CellCorners corners = grid.cell(cell[0], cell[1], cell[2]);
    saddles.clear();
    append_critical_points(corners, saddles);
    for (const CriticalPoint& saddle : saddles) {
      const int side = side_of_saddle(corners, isosurface.isovalue(), saddle);
      if (side != 0) append(saddle.uvw, side > 0);
    }
    for (unsigned critical = critical_corners(grid, cell); critical != 0; critical &= critical - 1) {
      const auto corner = static_cast<unsigned>(std::countr_zero(critical));
      append(
          {static_cast<double>(corner & 1u), static_cast<double>(corner >> 1 & 1u), static_cast<double>(corner >> 2)},
          corners[corner] > isosurface.isovalue());
    }
  });
}

void CriticalPlaces::renew(const ExchangedPoints& exchanged) {
  hint_ = restricted_.delaunay().incident_tet(VertexId(std::size_t{0}));
  std::vector<bool> is_renewed(restricted_.delaunay().tet_slots(), false);
  for (const TetId t : exchanged.renewed) is_renewed[t.index()] = true;
  for (CriticalPlace& place : places_) {
    if (is_renewed[place.tet.index()]) locate(place);
  }
}

void CriticalPlaces::locate(CriticalPlace& place) {
  const CellIndex& cell = place.cell;
  const Vec3 center = scaled({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}, restricted_.isosurface().step());
  place.tet = hint_ = restricted_.locate(place.point, center, hint_);
}

}  // namespace deliso
