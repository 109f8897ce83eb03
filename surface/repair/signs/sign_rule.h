// The sign of a tetrahedron in cells that repair has refined.
//
// The circumcenter of a flat tetrahedron in a thin wedge lies far outside the wedge. So in refined cells and the ring
// of cells around them a small tetrahedron takes the sign of the field at its centroid. Elsewhere the sign at the
// circumcenter is right: on a smooth, densely sampled sheet the centroids of flat tetrahedra give random signs.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/sign_constraints.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The rule for one triangulation and its refined cells. Data are updated only where points were exchanged or cells
// refined.
class SignRule {
 public:
  // Keeps references. The result does not depend on the number of threads.
  SignRule(SignedDelaunay& restricted, const CellLevels& cell_levels, int threads);

  // Updates the arrays after an exchange of points; call update() afterwards.
  void renew(const ExchangedPoints& exchanged);
  // Updates the data for the cells refined by now.
  void update();

  // Sets the sign of every tetrahedron: first that in `at_circumcenters` (SignedDelaunay::signs) or, in the zone of
  // refined cells, that at its centroid. Then a small tetrahedron whose sign constraint is one side takes this side,
  // whatever the rule says.
  void take_signs(const TetSigns& at_circumcenters);

 private:
  SignedDelaunay& restricted_;
  const CellLevels& cell_levels_;
  int threads_;
  SignConstraints constraints_;
  // Of each slot: the cell of the centroid of a small tetrahedron, or kNoCell, or kStale; and the side of the centroid
  // once its cell has entered the zone, which it never leaves.
  std::vector<CellName> centroid_cells_;
  std::vector<std::uint8_t> centroid_sides_;
};

}  // namespace deliso
