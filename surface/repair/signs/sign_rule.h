// Which sign a tetrahedron takes where repair has sampled finely.
//
// The circumcenter of a flat tetrahedron in a thin wedge lies far outside the wedge, so in raised cells and the ring
// around them the centroid of a small tetrahedron is asked. Elsewhere the circumcenter is right: on a smooth, densely
// sampled sheet flat tetrahedra get random signs from their centroids.
#pragma once

#include <utility>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/sign_constraints.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// For one triangulation and the raised cells. What is found is found again only where points have been exchanged or
// cells raised.
class SignRule {
 public:
  // Keeps references. What is found does not depend on the number of threads.
  SignRule(SignedDelaunay& restricted, const ScalarGrid& grid, const CellLevels& raised, int threads);

  // Takes account of an exchange of points; update() is to follow.
  void renew(const ExchangedPoints& exchanged);
  // Takes account of the cells that are raised by now.
  void update();

  // Gives every tetrahedron its sign: by `at_circumcenters` (SignedDelaunay::signs) or by its centroid; then each small
  // one that segments of known side cross takes their side, which the rule may not overrule.
  void take_signs(const TetSigns& at_circumcenters);

  // What is known of the sides in each tetrahedron (sign_constraints.h).
  [[nodiscard]] const std::vector<std::uint8_t>& evidence() const { return evidence_.sides(); }

 private:
  using Signs = std::vector<std::pair<TetId, bool>>;  // tetrahedra, and whether they are above
  static constexpr CellName kNoCell = ~CellName{0};
  void update_homes();
  void update_by_centroid();

  SignedDelaunay& restricted_;
  const CellLevels& raised_;
  int threads_;
  SignConstraints evidence_;
  Signs by_evidence_;            // of small tetrahedra with evidence of one side
  Signs by_centroid_;            // of small tetrahedra in the zone
  std::vector<CellName> homes_;  // of each slot: the cell that holds a small tetrahedron's centroid
  CellLevels::Zone zone_;        // as of the last update
  std::vector<TetId> renewed_;   // since then
};

}  // namespace deliso
