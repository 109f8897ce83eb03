// The exact predicates in the form in which marching cubes takes them.
#pragma once

#include "delaunay/predicates.h"
#include "delaunay/triangle_contact.h"
#include "volume/marching_cubes/exact_tests.h"

namespace deliso {

inline constexpr ExactTests kExactTests = {
    [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return orient3d(a, b, c, d); },
    [](const Vec3& a, const Vec3& b, const Vec3& c) { return has_area(a, b, c); },
    [](std::span<const Vec3> points, const std::array<std::uint32_t, 3>& s, const std::array<std::uint32_t, 3>& t) {
      return triangle_contact(points, s, t) != TriangleContact::kNone;
    }};

}  // namespace deliso
