// Stage 1 (Dey and Levine, section 3.1): refine the restricted Delaunay triangulation until it has the surface's
// topology.
//
// The paper's three steps run as one loop over a queue of violations, in the priority MultiIntersect, ExtractManifold,
// ApproximateGeom. Every insertion keeps a distance from all vertices (the size bound), without which the loop does not
// end at the creases of the trilinear interpolant.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/controls.h"
#include "surface/recover/recover_options.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

// Runs until no violation is left that the size bound lets us mend, or `controls` say stop. `pole_heights`, one for
// each vertex, is needed for a finite epsilon2; new vertices inherit from their neighbours (new_pole).
void recover(RestrictedDelaunay& restricted, const RecoverOptions& options, Controls& controls, RecoverStats& stats,
             std::vector<double>* pole_heights = nullptr);

// What the triangulation has counted of its searches, once all insertions are made.
void take_counters(const RestrictedDelaunay& restricted, RecoverStats& stats);

// Inserts points of the surface, as far as the size bound lets it, and runs until no violation is left that they have
// caused: for a triangulation that recover() has left without others, with the same options. Returns how many of the
// points went in; they count as `uncovered`.
std::int64_t recover_with(RestrictedDelaunay& restricted, std::span<const Vec3> points, const RecoverOptions& options,
                          Controls& controls, RecoverStats& stats);

}  // namespace deliso
