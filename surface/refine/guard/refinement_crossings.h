// Which triangles of a mesh in refinement meet beyond what they share: the exact check after the guard.
#pragma once

#include "surface/intersection/self_intersection.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// At most this many pairs of each kind are kept.
inline constexpr std::size_t kMostMeetingPairs = 1000;

// All pairs.
SelfIntersections meeting_pairs(const RefinementMesh& mesh, int threads);

// The pairs with a triangle that has been renewed since the mesh was made or joined.
SelfIntersections meeting_pairs_of_renewed(const RefinementMesh& mesh, int threads);

}  // namespace deliso
