// Exact geometric predicates. They decide; nothing else may.
//
// Evaluation is staged: a static filter from the known box, a dynamic error bound, an adaptive expansion, the exact
// expansion (Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997).
#pragma once

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

// The determinant [b - a, c - a, d - a]: positive when d lies on the side of the plane abc to which (b - a) x (c - a)
// points. The returned value has the exact sign and a small relative error; it is zero exactly when the four points are
// coplanar.
double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Positive when e lies strictly inside the circumball of the positively oriented tetrahedron abcd, negative outside,
// zero exactly on the sphere.
double insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

}  // namespace deliso
