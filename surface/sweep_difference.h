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

#include "surface/surface_mesh.h"

namespace deliso {

// Along each axis, for each sample layer, the Euler characteristic of what lies below it.
using SweptCharacteristics = std::array<std::vector<std::int64_t>, 3>;

// The first sample layer along each axis that a point in mesh space does not lie above.
std::array<std::int32_t, 3> layers_at(const Vec3& p, const Vec3& step, const std::array<std::int32_t, 3>& dims);

// Of several parts of a mesh, in one go over its triangles. `part_of_vertex`: below `parts`, the same for all vertices
// of a piece; kNoPart where it does not count. `step` is the size of a voxel in mesh space, `dims` the number of
// samples.
inline constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;
std::vector<SweptCharacteristics> swept_characteristics(const SurfaceMesh& mesh,
                                                        const std::vector<std::uint32_t>& part_of_vertex,
                                                        std::size_t parts, const Vec3& step,
                                                        const std::array<std::int32_t, 3>& dims);

// Along each axis the sample layers (ascending) at which the two part for good or meet again.
std::array<std::vector<std::int32_t>, 3> jumps_between(const SweptCharacteristics& mesh,
                                                       const SweptCharacteristics& exact);

}  // namespace deliso
