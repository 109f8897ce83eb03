// A point that stage 2 may insert: x_sigma of a coarse triangle, or one of the points below. A point of the boundary
// curve or at a halved edge is tried where x_sigma cannot be inserted.
#pragma once

#include <cstdint>
#include <optional>

#include "raycast/isosurface.h"
#include "surface/refine/disk/coverage_targets.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// A point to insert, the triangle from which its disk E is grown, and how E is special, if it is.
struct RefinementCandidate {
  Vec3 point;
  double ball_radius = 0;
  double nearest = 0;  // no vertex may be nearer to the point
  std::uint32_t seed = 0;
  TriangleSide split = kNoSide;   // the boundary edge on which the point lies
  TriangleSide halved = kNoSide;  // the inner edge whose two triangles form E
  bool is_coverage_target = false;
};

// A missed coverage target, for the triangle nearest to it; no vertex may be nearer than 0.3 mesh-space units and
// `r_min`.
RefinementCandidate target_candidate(const MissedTarget& missed, double r_min);

// For a boundary edge in a face of the box that is longer than `r_min`, and than a tenth of its triangle's other edges: a
// point of the boundary curve between its ends, namely the hit nearest to its midpoint on the bisector within the face.
std::optional<RefinementCandidate> boundary_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                      TriangleSide side, double r_min, SearchCounters& counters);

// For a triangle with an edge of at least `least_edge` and 2 `r_min`: a point of the surface near the middle of its
// longest edge, along the common normal of the two triangles at that edge, which then form E.
std::optional<RefinementCandidate> halving_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                     std::uint32_t triangle, double least_edge, double r_min,
                                                     SearchCounters& counters);

}  // namespace deliso
