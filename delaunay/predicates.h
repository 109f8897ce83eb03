// Exact geometric predicates. All combinatorial decisions are theirs.
//
// Evaluation is staged: floating point with a dynamic error bound, double-doubles with a bound, exact expansions
// (after Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997). Callers
// that know a box of all points put a static filter in front (delaunay/static_filter.h).
//
// Precondition of all: every coordinate is zero or has a magnitude in [2^-160, 2^200]. Then no product of up to five
// coordinate differences overflows, and none loses bits to underflow.
#pragma once

#include <array>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

// The determinant [b - a, c - a, d - a]: positive when d lies on the side of the plane abc to which (b - a) x (c - a)
// points. The returned value has the exact sign and a relative error below 2^-20; it is zero exactly when the four
// points are coplanar.
double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Positive when e lies strictly inside the circumball of the positively oriented tetrahedron abcd, negative outside,
// zero exactly on the sphere. Only the sign of the value is meaningful.
double insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

// Resolves insphere(tet, p) == 0 by the symbolic perturbation (see delaunay/bowyer_watson.h): whether p counts as
// inside. `ids` are the vertices of the positively oriented tetrahedron `tet`, `p_id` that of p; all five differ.
bool perturbed_insphere(const std::array<Vec3, 4>& tet, const std::array<VertexId, 4>& ids, const Vec3& p,
                        VertexId p_id);

// The sign of one coordinate of (b - a) x (c - a): 1, 0 or -1.
int normal_sign(const Vec3& a, const Vec3& b, const Vec3& c, unsigned axis);

// Whether three points lie on one line.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace deliso
