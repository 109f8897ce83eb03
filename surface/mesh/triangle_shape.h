// How well a triangle is shaped: the sine of its smallest angle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "delaunay/base/vec3.h"

namespace deliso {

// The square of twice the area over the product of the two longer edges; not a number for three equal points.
inline double squared_sine_of_least_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = squared_distance(a, b), bc = squared_distance(b, c), ca = squared_distance(c, a);
  const double shortest = std::min({ab, bc, ca});
  const double longer = shortest == ab ? bc * ca : shortest == bc ? ca * ab : ab * bc;
  return squared_norm(cross(b - a, c - a)) / longer;
}

// 0 where that is not a number. Not above sin(60 degrees) but for rounding.
inline double sine_of_least_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squared = squared_sine_of_least_angle(a, b, c);
  return squared > 0 ? std::sqrt(squared) : 0;
}

inline double longest_edge(const std::array<Vec3, 3>& p) {
  return std::sqrt(
      std::max({squared_distance(p[0], p[1]), squared_distance(p[1], p[2]), squared_distance(p[2], p[0])}));
}

}  // namespace deliso
