// Where a mesh and the exact surface part in topology, when no other sign tells.
//
// Sweep a plane along an axis and compare the Euler characteristic of what the mesh and a mesh with the exact topology
// have below it. A local difference in shape makes the two part for a moment; a tunnel more or less makes them part for
// good. The places where they part for good, along the three axes, are found as the jumps of the piecewise constant
// function that fits best.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Along each axis, for each sample layer, the Euler characteristic of what lies below it.
using EulerCurves = std::array<std::vector<std::int64_t>, 3>;

// A sample layer along each axis.
using SampleLayers = std::array<std::int32_t, 3>;

// The part of a vertex that does not count.
inline constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;
// Of several parts of a mesh, in one go over its triangles. `part_of_vertex`: the same for all vertices of a piece,
// below `parts` or kNoPart. `step` is the size of a voxel in mesh space, `dims` the number of samples.
std::vector<EulerCurves> euler_curves(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                      std::size_t parts, const Vec3& step, const std::array<std::int32_t, 3>& dims);

// Along each axis the sample layers (ascending) at which the two part for good or meet again.
std::array<std::vector<std::int32_t>, 3> jumps_between(const EulerCurves& mesh, const EulerCurves& exact);

}  // namespace deliso
