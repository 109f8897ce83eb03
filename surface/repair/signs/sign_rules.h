// Which sign a tetrahedron takes where repair has sampled finely.
//
// The circumcenter of a flat tetrahedron in a thin wedge lies far outside the wedge, so there the centroid is asked.
// But on a smooth, densely sampled sheet flat tetrahedra get random signs from their centroids. No rule is right
// everywhere; repair tries them in turn.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/sign_constraints.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

enum class SignRule {
  kAsBefore,              // as the round before had it in the end: what was mended there stays mended
  kCentroidWithRing,      // the centroid, for small tetrahedra in raised cells and the ring around them
  kCentroid,              // the same without the ring
  kCentroidWhereOpposed,  // the same, only where the gradients at two of the vertices oppose each other
  kCircumcenter,
};
// All of them, in the order in which repair tries them (RepairRound::rules).
inline constexpr std::array<SignRule, 5> kSignRules = {SignRule::kAsBefore, SignRule::kCentroidWithRing,
                                                       SignRule::kCentroid, SignRule::kCentroidWhereOpposed,
                                                       SignRule::kCircumcenter};

// The rules for one triangulation and the raised cells. What the rules have in common is found once, and again only
// where points have been exchanged or cells raised.
class SignRules {
 public:
  // Keeps references. What is found does not depend on the number of threads.
  SignRules(SignedDelaunay& restricted, const ScalarGrid& grid, const CellLevels& raised, int threads);

  // Takes account of an exchange of points; update() is to follow.
  void renew(const ExchangedPoints& exchanged);
  // Takes account of the cells that are raised by now.
  void update();

  // Gives every tetrahedron its sign by a rule; then each small one that segments of known side cross takes their side:
  // evidence that no rule may overrule. `start`: the signs that the rule changes (SignedDelaunay::signs), those of the
  // circumcenters or, for kAsBefore, those before.
  void take_signs(SignRule rule, const TetSigns& start);

  // What is known of the sides in each tetrahedron (sign_constraints.h).
  [[nodiscard]] const std::vector<std::uint8_t>& evidence() const { return evidence_.sides(); }

 private:
  struct Candidate {
    TetId tet;
    bool in_ring = false;  // of the raised cells; else in one of them
    bool is_above = false;
    bool is_opposed = false;  // gradients at two of the vertices oppose each other
  };
  static constexpr CellName kNoCell = ~CellName{0};
  void update_homes();
  void update_candidates();

  SignedDelaunay& restricted_;
  const CellLevels& raised_;
  int threads_;
  SignConstraints evidence_;
  std::vector<std::pair<TetId, bool>> overruled_;  // small tetrahedra with evidence of one side: whether it is above
  // Found when first needed:
  bool are_candidates_stale_ = true;
  std::vector<CellName> homes_;        // of each slot: the cell that holds a small tetrahedron's centroid
  CellLevels::Zones zones_;            // as they were when the candidates were found
  std::vector<TetId> renewed_;         // since then
  std::vector<Candidate> candidates_;  // for the sign of their centroid
};

}  // namespace deliso
