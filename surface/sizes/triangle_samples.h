// Where decimation measures how far a triangle is from the isosurface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "delaunay/base/vec3.h"
#include "surface/certificate/promise.h"

namespace deliso {

// Into how many parts the lattice of samples divides the edges of a triangle. Edges may be as long as some voxels but
// for rounding, which must not decide where samples lie: else what has been written has others.
inline int sample_order(double longest_edge) {
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::clamp(std::ceil((1 - kRounding) * longest_edge), 2.0, double(kMostSamplesPerEdge)));
}

// Calls visit(point) for points about a voxel apart on a triangle, the corners left out. `longest`: its longest edge.
template <class Visit>
void for_each_sample(const std::array<Vec3, 3>& corners, double longest, const Visit& visit) {
  const auto& [a, b, c] = corners;
  const int order = sample_order(longest);
  visit((a + b + c) / 3);
  for (int i = 0; i <= order; ++i) {
    for (int j = 0; i + j <= order; ++j) {
      if (std::max({i, j, order - i - j}) == order) continue;
      visit((double(i) * a + double(j) * b + double(order - i - j) * c) / double(order));
    }
  }
}

}  // namespace deliso
