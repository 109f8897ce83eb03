// Triangles without area: their corners lie in a line, exactly.
#pragma once

#include <algorithm>
#include <cstdint>

#include "delaunay/triangle_contact.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {

template <class Mesh>
std::int64_t count_without_area(const Mesh& mesh) {
  constexpr double kSurelyNot = 1e-20;  // squared sine of an angle
  return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    const Vec3 &a = mesh.points[triangle[0]], &b = mesh.points[triangle[1]], &c = mesh.points[triangle[2]];
    return !(squared_sine_of_least_angle(a, b, c) > kSurelyNot) && !has_area(a, b, c);
  });
}

}  // namespace deliso
