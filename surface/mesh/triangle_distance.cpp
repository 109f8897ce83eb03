#include "surface/mesh/triangle_distance.h"

#include <algorithm>
#include <optional>

namespace deliso {

namespace {

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  // In this order the greater of 0 and 0 / 0, for a segment without length, is 0.
  const double t = std::min(std::max(0.0, dot(p - a, b - a) / squared_norm(b - a)), 1.0);
  return squared_distance(p, a + t * (b - a));
}

// Where p lies above the inside of a triangle that has an area: the square of its height.
std::optional<double> squared_height_above_inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double area = squared_norm(n);
  if (!(area > 0 && dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
        dot(cross(a - c, p - c), n) >= 0))
    return std::nullopt;
  const double height = dot(p - a, n);
  return height * height / area;
}

}  // namespace

// Above the inside: the distance to the plane. Elsewhere, and for triangles without area: to the nearest edge.
double squared_distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (const auto squared_height = squared_height_above_inside(p, a, b, c)) return *squared_height;
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace deliso
