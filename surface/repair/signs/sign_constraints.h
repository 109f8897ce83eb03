// Segments along which the field stays on one side of the isovalue, and the sign constraints that follow for the
// tetrahedra they cross.
//
// Between two samples on the same side a grid edge stays on that side, because the interpolant is linear along it. From
// a saddle of a cell face the interpolant is monotone along the segments to the corners of the face. So the segments to
// the corners that lie farther on the saddle's own side stay on that side. These segments show what is connected within
// a cell. A tetrahedron that one of them crosses must have its sign, or the mesh would separate connected regions. All
// vertices lie on the isosurface, so a tetrahedron crossed by segments of both sides is too large for the surface
// around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The constraint of a tetrahedron: the sides of the segments of refined cells that cross it.
enum SignConstraint : std::uint8_t { kNoConstraint = 0, kAbove = 1, kBelow = 2, kConflict = 3 };

// Keeps the constraints up to date while points are exchanged and cells refined. Only cells that are new, or whose
// segments cross new tetrahedra, are visited.
class SignConstraints {
 public:
  // Keeps a reference.
  explicit SignConstraints(const SignedDelaunay& restricted) : restricted_(restricted) {}

  // Updates the arrays after an exchange of points; call update() afterwards.
  void renew(const ExchangedPoints& exchanged);
  // Updates the constraints for the cells refined by now. The same for any number of threads.
  void update(const CellLevels& cell_levels, int threads = 1);

  // The constraint of each slot.
  [[nodiscard]] const std::vector<std::uint8_t>& sides() const { return sides_; }

 private:
  // The tetrahedra, ghosts included, that the segments of a cell cross, ascending.
  struct Trace {
    CellName cell = 0;
    std::vector<TetId> tets;
    bool is_stale = true;
  };

  const SignedDelaunay& restricted_;
  std::vector<std::uint8_t> sides_;
  std::vector<Trace> traces_;  // of the refined cells, ascending
};

}  // namespace deliso
