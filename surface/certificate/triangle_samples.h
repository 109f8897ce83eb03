// Where the mesher measures how far a triangle is from the isosurface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "delaunay/base/vec3.h"
#include "surface/certificate/promise.h"

namespace deliso {

// Into how many parts the lattice of samples divides the edges of a triangle. Edges may be as long as some voxels but
// for rounding, which must not decide where samples lie: else what has been written has others.
inline int sample_order(double longest_edge) {
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::clamp(std::ceil((1 - kRounding) * longest_edge), 2.0, double(kMostSamplesPerEdge)));
}

// Calls visit(point) where the faces between voxel cells cut a triangle: on its edges, and in the middle between two of
// these points. There the isosurface has its creases, so there a small triangle is farthest from it. `step`: a cell.
// The triangle lies within the box of the volume.
template <class Visit>
void for_each_crease_sample(const std::array<Vec3, 3>& corners, const Vec3& step, const Visit& visit) {
  // An edge that is all but parallel to a face has no place where it crosses it.
  constexpr double kParallel = 1e-3;  // cells
  // Whether the ends of an edge in a face lie on both sides of it is up to rounding, and with it whether its middle is
  // between two points: it is a sample in any case.
  for (std::size_t i = 0; i < 3; ++i) visit(0.5 * (corners[i] + corners[(i + 1) % 3]));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<double, 3> at = {corners[0][axis] / step[axis], corners[1][axis] / step[axis],
                                      corners[2][axis] / step[axis]};
    const auto first = static_cast<std::int64_t>(std::ceil(std::min({at[0], at[1], at[2]})));
    const auto last = static_cast<std::int64_t>(std::floor(std::max({at[0], at[1], at[2]})));
    for (std::int64_t number = first; number <= last; ++number) {
      const auto face = static_cast<double>(number);
      std::array<Vec3, 2> ends;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if ((at[i] < face) == (at[next] < face) || std::abs(at[next] - at[i]) < kParallel) continue;
        const double along = (face - at[i]) / (at[next] - at[i]);
        ends.at(count) = (1 - along) * corners[i] + along * corners[next];
        visit(ends.at(count));
        ++count;
      }
      if (count == 2) visit(0.5 * (ends[0] + ends[1]));
    }
  }
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
