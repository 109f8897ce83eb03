// Triangles without area: their corners lie in a line, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "delaunay/triangle_contact.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {

inline bool is_without_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kSurelyNot = 1e-20;  // squared sine of an angle
  return !(squared_sine_of_least_angle(a, b, c) > kSurelyNot) && !has_area(a, b, c);
}
inline bool is_without_area(const std::array<Vec3, 3>& p) { return is_without_area(p[0], p[1], p[2]); }

template <class Mesh>
std::int64_t count_without_area(const Mesh& mesh) {
  return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    return is_without_area(mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]);
  });
}

}  // namespace deliso
