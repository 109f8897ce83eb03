// Which sign a tetrahedron takes where repair has sampled finely.
//
// The circumcenter of a flat tetrahedron in a thin wedge lies far outside the wedge, so there the centroid is asked.
// But on a smooth, densely sampled sheet flat tetrahedra get random signs from their centroids. No rule is right
// everywhere; repair tries them in turn.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/raised_cells.h"
#include "surface/signed_delaunay.h"

namespace deliso {

enum class SignRule {
  kCentroidWithRing,      // the centroid, for small tetrahedra in raised cells and the ring around them
  kCentroid,              // the same without the ring
  kCentroidWhereOpposed,  // the same, only where the gradients at two of the vertices oppose each other
  kCircumcenter,
};

// The rules for one triangulation and the raised cells as they stand. What the rules have in common is found once.
class SignRules {
 public:
  // `at_circumcenters`: the signs that every rule starts from (SignedDelaunay::signs). What is found does not depend
  // on the number of threads.
  SignRules(const SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised,
            std::vector<bool> at_circumcenters, int threads);

  // Gives every tetrahedron its sign by a rule; then each small one that segments of known side cross takes their side:
  // evidence that no rule may overrule. `restricted` is the triangulation of the constructor.
  void take_signs(SignRule rule, SignedDelaunay& restricted);

  // What is known of the sides in each tetrahedron (evidence.h).
  [[nodiscard]] const std::vector<std::uint8_t>& evidence() const { return evidence_; }

 private:
  struct Candidate {
    TetId tet;
    bool in_ring = false;  // of the raised cells; else in one of them
    bool is_above = false;
    bool is_opposed = false;  // gradients at two of the vertices oppose each other
  };
  void find_candidates(const SignedDelaunay& restricted);

  const RaisedCells& raised_;
  int threads_;
  std::vector<bool> at_circumcenters_;
  std::vector<std::uint8_t> evidence_;
  std::vector<std::pair<TetId, bool>> overruled_;  // small tetrahedra with evidence of one side: whether it is above
  std::vector<Candidate> candidates_;              // for the sign of their centroid; found when first needed
  bool has_candidates_ = false;
};

}  // namespace deliso
