// Where a mesh and the exact surface part in topology, when no other sign tells.
//
// Sweep a plane along an axis and compare the Euler characteristic of what the mesh and a mesh with the exact topology
// have below it. A local difference in shape makes the two part for a moment; a tunnel more or less makes them part for
// good. The places where they part for good, along the three axes, are found as the jumps of the piecewise constant
// function that fits best.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/surface_mesh.h"

namespace deliso {

// A mesh and which of its vertices count (the pieces that they belong to count as a whole).
struct MeshPart {
  const SurfaceMesh& mesh;
  std::function<bool(std::uint32_t)> counts;
};

// Along each axis the sample layers (ascending) at which the two part for good or meet again. `step` is the size of a
// voxel in mesh space, `dims` the number of samples.
std::array<std::vector<std::int32_t>, 3> jumps_between(const MeshPart& mesh, const MeshPart& exact, const Vec3& step,
                                                       const std::array<std::int32_t, 3>& dims);

}  // namespace deliso
