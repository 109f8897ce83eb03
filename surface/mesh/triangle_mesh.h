// An indexed triangle mesh: the output of the mesher and the input of the checks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Triangles are counterclockwise seen from the side of lower values. Points are in world coordinates.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> labels{};  // of each triangle; empty: none
};

}  // namespace deliso
