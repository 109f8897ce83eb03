// The trilinear interpolant of one voxel cell, in the cell's own parameters (u, v, w) in [0, 1]^3.
//
// Guaranteed bit for bit, because every step is a linear interpolation that is exact at both ends:
// - the value at a corner is the sample;
// - the value on a face or an edge is the same from every cell that shares it (given the same parameters in it), and so
//   are the components of the gradient along that face or edge;
// - for integer samples (and whenever differences of samples are exact) the value never leaves the corners' range, and
// it
//   is constant when the corners are.
// The components of the gradient across a face do differ between its two cells: the interpolant has a crease there.
#pragma once

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Linear interpolation from a (t = 0) to b (t = 1), exact at both ends and for a = b: measured from the nearer end.
inline double interpolate(double a, double b, double t) {
  const bool near_a = t < 0.5;
  return (near_a ? a : b) + (near_a ? t : t - 1.0) * (b - a);
}

// Bilinear interpolation of the corners c00, c10, c01, c11 (first digit s, second t).
inline double interpolate(double c00, double c10, double c01, double c11, double s, double t) {
  return interpolate(interpolate(c00, c10, s), interpolate(c01, c11, s), t);
}

// g(u, v, w) = c[0] + c[1] u + c[2] v + c[3] uv + c[4] w + c[5] uw + c[6] vw + c[7] uvw. Values at the corners and
// along the cell's edges come out the same from every cell that shares them (they are computed by interpolation, not
// from c).
inline double trilinear_value(const CellCorners& corners, const Vec3& uvw) {
  const double below = interpolate(corners[0], corners[1], corners[2], corners[3], uvw.x, uvw.y);
  const double above = interpolate(corners[4], corners[5], corners[6], corners[7], uvw.x, uvw.y);
  return interpolate(below, above, uvw.z);
}

// Its gradient with respect to (u, v, w).
inline Vec3 trilinear_gradient(const CellCorners& corners, const Vec3& uvw) {
  const CellCorners& c = corners;
  const double below = interpolate(c[0], c[1], c[2], c[3], uvw.x, uvw.y);
  const double above = interpolate(c[4], c[5], c[6], c[7], uvw.x, uvw.y);
  return {interpolate(c[1] - c[0], c[3] - c[2], c[5] - c[4], c[7] - c[6], uvw.y, uvw.z),
          interpolate(c[2] - c[0], c[3] - c[1], c[6] - c[4], c[7] - c[5], uvw.x, uvw.z), above - below};
}

// The coefficients c of the polynomial above. For integer samples of at most 32 bits they are exact.
inline CellCorners trilinear_coefficients(const CellCorners& corners) {
  CellCorners c = corners;
  for (std::size_t axis = 1; axis <= 4; axis *= 2)
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner & axis) != 0) c[corner] -= c[corner - axis];
  return c;
}

}  // namespace deliso
