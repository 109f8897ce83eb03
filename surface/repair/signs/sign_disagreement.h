// Tetrahedra on whose sign the rules disagree, in clusters, and what it would change to turn them over.
//
// Where sweeps tell that a component has a handle too many or too few, and about where, some rule is often right just
// there that is wrong elsewhere. So its signs are taken for one cluster at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

struct DisagreementCluster {
  std::vector<TetId> tets;    // hang together over common facets
  std::int32_t distance = 0;  // of the nearest of them
};

// The tetrahedra with a sign other than in `signs` (by slot) that are near: distance(t) gives how far away one is, as a
// negative number when it is too far to count. The nearest clusters come first.
std::vector<DisagreementCluster> disagreement_clusters(const SignedDelaunay& restricted, const TetSigns& signs,
                                                       const std::function<std::int32_t(TetId)>& distance);

}  // namespace deliso
