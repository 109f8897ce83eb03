// Coverage targets: points of the surface that lie some distance from the coarse triangles of stage 1, and that the
// mesh of stage 2 has to come near.
//
// Stage 2 samples the surface only where dual lines of its triangles meet it. A thin finger of the surface may rise
// from a coarse triangle and be smaller than that triangle is off the surface, so stage 1 need not have sampled it.
// Refinement then brings the mesh near to the surface all around the finger, but may never hit the finger itself.
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

// B_sigma of a triangle of the mesh; several threads may call it at the same time. Also a ball that is stored in the
// mesh must hold its triangle, or have no radius.
using BallOf = std::function<SurfaceDelaunayBall(std::uint32_t triangle)>;

// The coverage targets that no triangle of the mesh is near, farthest first. Near means within `least` or 0.8
// mesh-space units, whichever is more. A triangle with an edge longer than 4 units is also near within twice its own
// height h, but at most within the length of that edge: where the surface is smooth the triangle may be that far off. A
// coverage target without any triangle within 6 units is left out. With `is_all`, near means within `least` alone. The
// same for any number of threads.
std::vector<MissedTarget> missed_targets(std::span<const Vec3> coverage_targets, const RefinementMesh& mesh,
                                         const BallOf& ball_of, double least, int threads, bool is_all = false);

}  // namespace deliso
