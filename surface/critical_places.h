// Saddles and critical samples of the field, and the tetrahedra that hold them.
//
// There the topology of the isosurface is decided, and the exact side of each is known. Where they are depends on the
// volume alone; the tetrahedra are looked for again only as points are exchanged.
#pragma once

#include <span>
#include <vector>

#include "surface/signed_delaunay.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct CriticalPlace {
  Vec3 point;      // in mesh space
  CellIndex cell;  // that it was found in; a sample is found in each of its cells
  TetId tet;       // that holds it, towards the cell's center
  bool is_above = false;
};

class CriticalPlaces {
 public:
  // Those of the cells that have some. Keeps a reference to the triangulation. The same for any number of threads.
  CriticalPlaces(const SignedDelaunay& restricted, const ScalarGrid& grid, std::span<const CellIndex> cells,
                 int threads);

  // Takes account of an exchange of points.
  void renew(const ExchangedPoints& exchanged);

  [[nodiscard]] const std::vector<CriticalPlace>& places() const { return places_; }

 private:
  [[nodiscard]] TetId located(const CriticalPlace& place, TetId hint) const;

  const SignedDelaunay& restricted_;
  std::vector<CriticalPlace> places_;
};

}  // namespace deliso
