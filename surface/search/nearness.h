// When a mesh is near a point of the surface. Distances are in mesh-space units; the smallest spacing is one.
//
// `verify` fails where the surface is more than one voxel off the mesh (surface/verification/verification.cpp). Each
// constant leaves room below that for what happens between the question and the end of the run.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/base/box3.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/mesh/triangle_distance.h"

namespace deliso::nearness {

// A sample that the mesh does not use. Stage 1 leaves out crossings that are nearer to a sample than
// stage1.size_bound_voxels (0.3), so the crossings around the sample lie less than one off the mesh, too.
inline constexpr double kSample = 0.65;
// A crossing or a coverage target. Nothing is inserted around one that is as near as this; stage 2 moves the mesh a
// little.
inline constexpr double kCrossing = 0.8;
// A crossing that need not become a coverage target of stage 2, which may move the mesh by what is left to kCrossing.
inline constexpr double kClose = 0.5;
// A crossing and a coarse triangle, in circumradii: as far off the surface as stage 1 lets the middle of a triangle be.
// Stage 2 brings that triangle nearer.
inline constexpr double kOfCircumradius = 0.3;
// A vertex that leaves the mesh, and what stays of it. The vertex lies on the surface: another sheet must be there
// already.
inline constexpr double kRemoved = 0.2;
// The middle of a triangle and a part of the surface that faces the same way: as kClose, the other way round.
inline constexpr double kFacing = kClose;

inline double squared_distance(const Vec3& p, const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return squared_distance_to_triangle(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}
// Whether p lies within some distance of a triangle.
inline bool is_near(const Vec3& p, const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t, double within) {
  return squared_distance(p, mesh, t) <= within * within;
}
// All that is so near to something in a box lies in this one.
inline Box3 widened(const Box3& box, double within) {
  const Vec3 around{within, within, within};
  return {box.low - around, box.high + around};
}

}  // namespace deliso::nearness
