// Coverage targets: points of the surface that the coarse triangles of stage 1 pass by at some distance, and that the
// mesh of stage 2 has to come near.
//
// Stage 2 sees the surface only where dual lines of its triangles meet it. A finger that stands on a coarse triangle
// may be smaller than that triangle is off the surface, so stage 1 need not have sampled it; and then refinement, which
// brings the mesh near to the surface all around, may never hit it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

struct MissedTarget {
  Vec3 point;
  std::uint32_t triangle = 0;  // the nearest one, the first of equals
  double squared_distance = 0;
};

// B_sigma of a triangle of the mesh; may be asked by several threads at a time. What the mesh keeps as a ball must hold
// its triangle, too, or have no radius.
using BallOf = std::function<SurfaceDelaunayBall(std::uint32_t triangle)>;

// The coverage targets that a mesh has no triangle near, farthest first. Near is within `least` or
// nearness::kCrossing (surface/search/nearness.h), whichever is more; and a triangle with an edge longer than 4 units
// is near as far as twice its own height h, but no farther than its edge is long, for where the surface is smooth it
// may be that far off. A coverage target without any triangle within 6 units is not told of. The same for any number of
// threads.
std::vector<MissedTarget> missed_targets(std::span<const Vec3> coverage_targets, const RefinementMesh& mesh,
                                         const BallOf& ball_of, double least, int threads);

}  // namespace deliso
