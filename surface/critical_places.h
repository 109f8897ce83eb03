// Saddles and critical samples of the field, and the tetrahedra that hold them.
//
// There the topology of the isosurface is decided, and the exact side of each is known. Where they are depends on the
// volume alone; a tetrahedron is looked for when it is asked for, and again only as points are exchanged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/signed_delaunay.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct CriticalPlace {
  Vec3 point;      // in mesh space
  CellIndex cell;  // that it was found in; a sample is found in each of its cells
  bool is_above = false;
};

// Those of the active cells, cell by cell, x fastest.
std::vector<CriticalPlace> critical_places(const ScalarGrid& grid, const Isosurface& isosurface,
                                           const CrossingIndex& index);

class LocatedPlaces {
 public:
  // Keeps references.
  LocatedPlaces(const SignedDelaunay& restricted, const std::vector<CriticalPlace>& places)
      : restricted_(restricted), places_(places), tets_(places.size()) {}

  // Takes account of an exchange of points.
  void renew(const ExchangedPoints& exchanged);

  [[nodiscard]] const std::vector<CriticalPlace>& places() const { return places_; }
  // Finds the tetrahedra of these places (ascending); the same for any number of threads.
  void locate(std::span<const std::uint32_t> wanted, int threads);
  // That holds a place which has been located, towards its cell's center.
  [[nodiscard]] TetId tet(std::uint32_t place) const { return tets_[place]; }

 private:
  [[nodiscard]] TetId located(const CriticalPlace& place, TetId hint) const;

  const SignedDelaunay& restricted_;
  const std::vector<CriticalPlace>& places_;
  std::vector<TetId> tets_;  // of each place, as far as it has been asked for
};

}  // namespace deliso
