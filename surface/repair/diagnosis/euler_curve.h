// Where a mesh and the exact surface part in topology, when no other sign tells.
//
// Sweep a plane along an axis and compare the Euler characteristic of what the mesh and a mesh with the exact topology
// have below it. A local difference in shape makes the two part for a moment; a tunnel more or less makes them part for
// good. The places where they part for good, along the three axes, are found as the jumps of the piecewise constant
// function that fits best.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Along each axis, for each sample layer, the Euler characteristic of what lies below it.
using EulerCurves = std::array<std::vector<std::int64_t>, 3>;

// A sample layer along each axis.
using SampleLayers = std::array<std::int32_t, 3>;
inline SampleLayers highest(const SampleLayers& a, const SampleLayers& b) {
  return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}
// The first sample layer along each axis that a point in mesh space does not lie above.
SampleLayers layers_at(const Vec3& p, const Vec3& step, const std::array<std::int32_t, 3>& dims);

// Where a part of a mesh changes in Euler characteristic as three planes come to these layers, in one go over its
// triangles: calls visit(part, layers, change). `part_of_vertex`: the same for all vertices of a piece; kNoPart where
// it does not count.
inline constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;
template <class Visit>
void for_each_mesh_change(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex, const Vec3& step,
                          const std::array<std::int32_t, 3>& dims, Visit&& visit);

// Of several parts of a mesh, in one go over its triangles. `part_of_vertex`: as above, below `parts`. `step` is the
// size of a voxel in mesh space, `dims` the number of samples.
std::vector<EulerCurves> euler_curves(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                      std::size_t parts, const Vec3& step, const std::array<std::int32_t, 3>& dims);

// Along each axis the sample layers (ascending) at which the two part for good or meet again.
std::array<std::vector<std::int32_t>, 3> jumps_between(const EulerCurves& mesh, const EulerCurves& exact);

// V - E + F: each simplex counts from the highest layers of its vertices on.
template <class Visit>
void for_each_mesh_change(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex, const Vec3& step,
                          const std::array<std::int32_t, 3>& dims, Visit&& visit) {
  // A vertex counts when a triangle has it; its layers are found then.
  constexpr std::int32_t kUnseen = -1;
  std::vector<SampleLayers> layers(mesh.points.size(), {kUnseen, 0, 0});
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const std::uint32_t part = part_of_vertex[v[0]];
    if (part == kNoPart) continue;
    for (const std::uint32_t q : v) {
      if (layers[q][0] != kUnseen) continue;
      layers[q] = layers_at(mesh.points[q], step, dims);
      visit(part, layers[q], 1);
    }
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide across = mesh.neighbours[t][i];  // an edge counts from the larger of its two sides
      if (across != kNoSide && across > 4 * t + i) continue;
      visit(part, highest(layers[v[(i + 1) % 3]], layers[v[(i + 2) % 3]]), -1);
    }
    visit(part, highest(highest(layers[v[0]], layers[v[1]]), layers[v[2]]), 1);
  }
}

}  // namespace deliso
