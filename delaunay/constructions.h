// Rounded constructions: circumcenters of triangles and tetrahedra. They measure, they never decide.
#pragma once

#include "delaunay/base/vec3.h"

namespace deliso {

struct Circumcircle {
  Vec3 center;
  double radius = 0;
};

// The circumcenter of the positively oriented tetrahedron abcd. The denominator is the exact-signed orient3d, so a
// nearly flat tetrahedron sends its center far off on the correct side; the result is always finite.
Vec3 circumcenter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// The circumcircle of the triangle abc; for a degenerate triangle the radius is infinite and the center its longest
// edge's midpoint.
Circumcircle circumcircle(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace deliso
