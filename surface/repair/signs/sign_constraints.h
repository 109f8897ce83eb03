// Where the field is known to keep to one side of the isovalue, and which tetrahedra that concerns.
//
// Between two samples on the same side a grid edge keeps to that side, for the interpolant is linear there. From a
// saddle of a cell face the interpolant is monotone along the segments to the corners of the face, so those to the
// corners that lie farther on the saddle's own side keep to it. These segments tell what is joined to what within a
// cell: a tetrahedron that one of them crosses must have its sign, or the mesh cuts apart what belongs together. All
// vertices lie on the isosurface, so a tetrahedron that segments of both sides cross is too large for the surface
// around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// Of each tetrahedron (by slot): which sides segments of the raised cells that cross it lie on.
enum SignConstraint : std::uint8_t { kNoConstraint = 0, kAbove = 1, kBelow = 2, kConflict = 3 };

// Keeps the evidence of the raised cells up to date as points are exchanged and cells raised: only cells that are new,
// or whose segments cross tetrahedra that are, are gone through.
class SignConstraints {
 public:
  // Keeps references.
  SignConstraints(const SignedDelaunay& restricted, const ScalarGrid& grid) : restricted_(restricted), grid_(grid) {}

  // Takes account of an exchange of points; update() is to follow.
  void renew(const ExchangedPoints& exchanged);
  // Takes account of the cells that are raised by now. The same for any number of threads.
  void update(const CellLevels& raised, int threads = 1);

  // Of each slot.
  [[nodiscard]] const std::vector<std::uint8_t>& sides() const { return sides_; }

 private:
  // The tetrahedra, ghosts included, that a cell's evidence was found in, ascending.
  struct Trace {
    CellName cell = 0;
    std::vector<TetId> tets;
    bool is_stale = true;
  };

  const SignedDelaunay& restricted_;
  const ScalarGrid& grid_;
  std::vector<std::uint8_t> sides_;
  std::vector<Trace> traces_;  // of the raised cells, ascending
};

}  // namespace deliso
