// Which point stage 2 inserts instead of x_sigma, where x_sigma will not do.
#pragma once

#include <cstdint>
#include <optional>

#include "raycast/isosurface.h"
#include "surface/refine/disk/coverage_targets.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// A point to insert, the triangle its disk E grows from, and what is special about E, if anything.
struct RefinementCandidate {
  Vec3 point;
  double ball_radius = 0;
  double nearest = 0;  // no vertex may be nearer to the point
  std::uint32_t seed = 0;
  TriangleSide split = kNoSide;   // the boundary edge on which the point lies
  TriangleSide halved = kNoSide;  // the inner edge whose two triangles alone make up E
  bool is_coverage_target = false;
};

// A coverage target, for the triangle next to it, unless a vertex is nearer than 0.3 mesh-space units and `r_min`.
RefinementCandidate target_candidate(const MissedTarget& missed, double r_min);

// A point of the boundary curve between the ends of a boundary edge of the box's face, if the edge is longer than
// `r_min`: the hit nearest to its midpoint on the bisector within the face.
std::optional<RefinementCandidate> boundary_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                      TriangleSide side, double r_min, SearchCounters& counters);

// For a coarse triangle, one with an edge of at least 1.5 mesh-space units and 2 `r_min`: a point of the surface near
// the middle of its longest edge, along the common normal of the two triangles there, which then make up E.
std::optional<RefinementCandidate> halving_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                     std::uint32_t triangle, double r_min, SearchCounters& counters);

}  // namespace deliso
