// Saddles and critical samples of the field, and the tetrahedra that hold them.
//
// There the topology of the isosurface is decided, and the exact side of each is known. Where they are depends on the
// volume alone: they are found once, in the cells that are asked for. A tetrahedron is looked for when it is asked for,
// and again only as points are exchanged.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/restricted/signed_delaunay.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

struct LocatedCriticalPoint {
  Vec3 point;      // in mesh space
  CellIndex cell;  // that it was found in; a sample is found in each of its cells
  bool is_above = false;
};

// The order of cells, x fastest.
inline bool is_before(const CellIndex& a, const CellIndex& b) {
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

class LocatedCriticalPoints {
 public:
  // Keeps a reference.
  explicit LocatedCriticalPoints(const SignedDelaunay& restricted) : restricted_(restricted) {}

  // Takes account of an exchange of points.
  void renew(const ExchangedPoints& exchanged);

  // Finds those of some cells (x fastest); the same for any number of threads.
  void find(std::span<const CellIndex> cells, int threads);
  // Of all cells that have been asked for, cell by cell, x fastest.
  [[nodiscard]] const std::vector<LocatedCriticalPoint>& places() const { return places_; }
  // Finds the tetrahedra of these places (ascending); the same for any number of threads.
  void locate(std::span<const std::uint32_t> wanted, int threads);
  // That holds a place which has been located, towards its cell's center.
  [[nodiscard]] TetId tet(std::uint32_t place) const { return tets_[place]; }

 private:
  void add(const std::vector<LocatedCriticalPoint>& found);
  [[nodiscard]] TetId located(const LocatedCriticalPoint& place, TetId hint) const;

  const SignedDelaunay& restricted_;
  std::vector<LocatedCriticalPoint> places_;
  std::vector<TetId> tets_;  // of each place, as far as it has been asked for
};

}  // namespace deliso
