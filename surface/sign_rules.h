// Which sign a tetrahedron takes where repair has sampled finely.
//
// The circumcenter of a flat tetrahedron in a thin wedge lies far outside the wedge, so there the centroid is asked.
// But on a smooth, densely sampled sheet flat tetrahedra get random signs from their centroids. No rule is right
// everywhere; repair tries them in turn.
#pragma once

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

// Gives every tetrahedron its sign by a rule, starting from the signs of the circumcenters (SignedDelaunay::signs, by
// slot), and then, in raised cells, each tetrahedron that holds a critical
// point of the interpolant the sign of that point: evidence that no rule may overrule, for where the surface passes a
// critical point its topology changes.
void take_signs(SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised,
                const std::vector<bool>& at_circumcenters, SignRule rule);

}  // namespace deliso
