#include "surface/shape/swept_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/mesh/triangle_distance.h"

namespace deliso {

namespace {

// The signed solid angle that a triangle fills, seen from p (van Oosterom and Strackee, The solid angle of a plane
// triangle, 1983); 0 for a triangle that p lies on.
double solid_angle(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double volume = dot(a, cross(b, c));
  const double sum = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return volume == 0 ? 0 : 2 * std::atan2(volume, sum);
}

bool lies_on(std::span<const std::array<Vec3, 3>> triangles, const Vec3& p) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const std::array<Vec3, 3>& triangle) {
    return squared_distance_to_triangle(p, triangle[0], triangle[1], triangle[2]) == 0;
  });
}

// Whether a sample's neighbours all lie on the other side: then a bubble of the isosurface stands around it.
bool stands_alone(const Isosurface& isosurface, const std::array<std::int64_t, 3>& at) {
  const ScalarGrid& grid = isosurface.grid();
  const auto is_above = [&](std::array<std::int64_t, 3> p) {
    return grid.at(static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1]), static_cast<std::int32_t>(p[2])) >=
           isosurface.isovalue();
  };
  const bool its = is_above(at);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::array<std::int64_t, 3> p = at;
      p[axis] += side;
      if (p[axis] >= 0 && p[axis] < grid.dims()[axis] && is_above(p) == its) return false;
    }
  }
  return true;
}

}  // namespace

bool sweeps_lone_sample(std::span<const std::array<Vec3, 3>> removed, std::span<const std::array<Vec3, 3>> added,
                        const Isosurface& isosurface) {
  // A sample inside sees the whole sphere; one in the face of the box at which the swept part is open sees half of it.
  constexpr double kHalfway = std::numbers::pi;
  // Bubbles of stage 1 may have their sample on an edge: of these it sees but twice the angle between the faces there.
  // They may go around it, but not leave it.
  constexpr double kLoss = 1;
  Box3 box;
  for (const auto& triangles : {removed, added}) {
    for (const std::array<Vec3, 3>& corners : triangles) {
      for (const Vec3& p : corners) box.extend(p);
    }
  }
  const Vec3& step = isosurface.step();
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = static_cast<std::int64_t>(std::ceil(box.low[axis] / step[axis]));
    last[axis] = static_cast<std::int64_t>(std::floor(box.high[axis] / step[axis]));
    first[axis] = std::max<std::int64_t>(first[axis], 0);
    last[axis] = std::min<std::int64_t>(last[axis], isosurface.grid().dims()[axis] - 1);
  }
  for (std::int64_t k = first[2]; k <= last[2]; ++k) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      for (std::int64_t i = first[0]; i <= last[0]; ++i) {
        const Vec3 p = scaled({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}, step);
        if (!stands_alone(isosurface, {i, j, k})) continue;
        double angle = 0;
        for (const std::array<Vec3, 3>& triangle : added) angle += solid_angle(triangle, p);
        for (const std::array<Vec3, 3>& triangle : removed) angle -= solid_angle(triangle, p);
        const double gain = isosurface.is_above(p) ? angle : -angle;
        if (gain < -kLoss || (gain > kHalfway && !lies_on(removed, p))) return true;
      }
    }
  }
  return false;
}

}  // namespace deliso
