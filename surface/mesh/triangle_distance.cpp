#include "surface/mesh/triangle_distance.h"

#include <algorithm>
#include <limits>

namespace deliso {

namespace {

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  // In this order the greater of 0 and 0 / 0, for a segment without length, is 0.
  const double t = std::min(std::max(0.0, dot(p - a, b - a) / squared_norm(b - a)), 1.0);
  return squared_distance(p, a + t * (b - a));
}

}  // namespace

// Above the inside: the distance to the plane. Elsewhere the nearest point lies on an edge that p is beyond; for
// triangles without area on any.
double squared_distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, pa = p - a, n = cross(ab, c - a);
  const double area = squared_norm(n);
  const bool has_area = area > 0;
  const bool is_in_ab = has_area && dot(cross(ab, pa), n) >= 0;
  const bool is_in_bc = has_area && dot(cross(c - b, p - b), n) >= 0;
  const bool is_in_ca = has_area && dot(cross(a - c, p - c), n) >= 0;
  if (is_in_ab && is_in_bc && is_in_ca) {
    const double height = dot(pa, n);
    return height * height / area;
  }
  double least = std::numeric_limits<double>::infinity();
  if (!is_in_ab) least = squared_distance_to_segment(p, a, b);
  if (!is_in_bc) least = std::min(least, squared_distance_to_segment(p, b, c));
  if (!is_in_ca) least = std::min(least, squared_distance_to_segment(p, c, a));
  return least;
}

}  // namespace deliso
