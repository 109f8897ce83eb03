// The distance from a point to a triangle, as the mesher measures it.
#pragma once

#include "delaunay/base/vec3.h"

namespace deliso {

// The squared distance from p to the triangle abc, which may be degenerate.
double squared_distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace deliso
