// A mesh for tests that cut meshes.
#pragma once

#include <cmath>
#include <cstdint>

#include "surface/mesh/surface_mesh.h"

namespace deliso::testing {

// A wavy square of n x n squares, cut into triangles.
inline SurfaceMesh wavy_square(std::uint32_t n) {
  SurfaceMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({double(i), double(j), std::sin(0.3 * i + 0.2 * j)});
  }
  mesh.pole_heights.assign(mesh.points.size(), 1);
  const auto square = [&](std::uint32_t i, std::uint32_t j) { return 2 * (j * n + i); };
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t at = j * (n + 1) + i;
      mesh.triangles.push_back({at, at + 1, at + n + 2});
      mesh.neighbours.push_back({i + 1 < n ? 4 * (square(i + 1, j) + 1) + 1 : kNoSide, 4 * (square(i, j) + 1) + 2,
                                 j > 0 ? 4 * (square(i, j - 1) + 1) + 0 : kNoSide});
      mesh.triangles.push_back({at, at + n + 2, at + n + 1});
      mesh.neighbours.push_back({j + 1 < n ? 4 * square(i, j + 1) + 2 : kNoSide,
                                 i > 0 ? 4 * square(i - 1, j) + 0 : kNoSide, 4 * square(i, j) + 1});
    }
  }
  return mesh;
}

}  // namespace deliso::testing
