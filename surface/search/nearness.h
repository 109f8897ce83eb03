// When a mesh counts as near a point of the surface. Distances are in mesh-space units; the smallest spacing is 1.
//
// `verify` fails if the surface is more than one voxel off the mesh (surface/verification/verification.cpp). Each
// constant is smaller, to leave room for changes of the mesh between the test and the end of the run.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/base/box3.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/mesh/triangle_distance.h"

namespace deliso::nearness {

// For a sample that is no vertex of the mesh. Stage 1 skips crossings nearer to a sample than stage1.size_bound_voxels
// (0.3), so the crossings around the sample lie less than 1 off the mesh, too.
inline constexpr double kSample = 0.65;
// For a crossing or a coverage target: nothing is inserted around one that is as near as this. Stage 2 moves the mesh
// slightly.
inline constexpr double kCrossing = 0.8;
// For a crossing that need not become a coverage target of stage 2. Stage 2 may move the mesh by the difference to
// kCrossing.
inline constexpr double kClose = 0.5;
// For a crossing and a coarse triangle, in circumradii: stage 1 allows the middle of a triangle to be this far off the
// surface. Stage 2 brings that triangle nearer.
inline constexpr double kOfCircumradius = 0.3;
// For a removed vertex and the rest of the mesh. The vertex lies on the surface, so another sheet must be there
// already.
inline constexpr double kRemoved = 0.2;
// For the middle of a triangle and a part of the surface that faces the same way: like kClose, with the roles
// exchanged.
inline constexpr double kFacing = kClose;

inline double squared_distance(const Vec3& p, const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return squared_distance_to_triangle(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}
// Whether p lies within some distance of a triangle.
inline bool is_near(const Vec3& p, const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t, double within) {
  return squared_distance(p, mesh, t) <= within * within;
}
// A box that holds everything within this distance of something in `box`.
inline Box3 widened(const Box3& box, double within) {
  const Vec3 around{within, within, within};
  return {box.low - around, box.high + around};
}

}  // namespace deliso::nearness
