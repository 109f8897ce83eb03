// How much of the sphere around a point a triangle fills.
#pragma once

#include <array>
#include <cmath>

#include "delaunay/base/vec3.h"

namespace deliso {

// The signed solid angle that a triangle fills, seen from p (van Oosterom and Strackee, The solid angle of a plane
// triangle, 1983): positive where p lies on the side that the triangle does not face; 0 for a triangle that p lies on.
// Those of a closed mesh that faces outward add up to 4 pi at points inside, and to 0 at others.
inline double solid_angle(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double volume = dot(a, cross(b, c));
  const double sum = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return volume == 0 ? 0 : 2 * std::atan2(volume, sum);
}

}  // namespace deliso
