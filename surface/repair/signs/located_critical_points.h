// Saddles and critical samples of the field, and the tetrahedra that hold them.
//
// The topology of the isosurface is decided at these points, and the side of each is known exactly. Their positions
// depend on the volume alone: they are computed once, in the cells that are requested. The tetrahedron of a point is
// searched when it is requested, and again only after an exchange of points.
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
  CellIndex cell;  // the cell in which it was found; a sample is found in each of its cells
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

  // Updates the stored tetrahedra after an exchange of points.
  void renew(const ExchangedPoints& exchanged);

  // Finds the points of some cells (x fastest); the same for any number of threads.
  void find(std::span<const CellIndex> cells, int threads);
  // The points of all cells requested so far, cell by cell, x fastest.
  [[nodiscard]] const std::vector<LocatedCriticalPoint>& points() const { return points_; }
  // Finds the tetrahedra of these points (ascending indices); the same for any number of threads.
  void locate(std::span<const std::uint32_t> wanted, int threads);
  // The tetrahedron that holds a located point, in the direction of its cell's center.
  [[nodiscard]] TetId tet(std::uint32_t place) const { return tets_[place]; }

 private:
  void add(const std::vector<LocatedCriticalPoint>& found);
  [[nodiscard]] TetId located(const LocatedCriticalPoint& place, TetId hint) const;

  const SignedDelaunay& restricted_;
  std::vector<LocatedCriticalPoint> points_;
  std::vector<TetId> tets_;               // of each point, as far as it was requested
  std::vector<std::uint8_t> is_located_;  // whether it still is that tetrahedron
};

}  // namespace deliso
