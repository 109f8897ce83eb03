// A ray within one voxel cell.
#pragma once

#include "delaunay/base/vec3.h"
#include "raycast/cubic_solver.h"
#include "raycast/search_options.h"
#include "volume/trilinear_cell.h"

namespace deliso {

// The field minus the isovalue at the eight corners of a cell. The signs are exact, and interpolation keeps them: if
// all corners lie on one side, so does every interpolated value.
inline CellCorners relative_to(const CellCorners& corners, double isovalue) {
  CellCorners relative;
  for (std::size_t i = 0; i < 8; ++i) relative[i] = corners[i] - isovalue;
  return relative;
}

// Do corners lie on both sides?
inline bool holds_isovalue(const CellCorners& relative) {
  unsigned above = 0;
  for (const double value : relative) above += static_cast<unsigned>(value >= 0);
  return above != 0 && above != 8;
}

// Interpolation that keeps signs and is exact at both ends.
inline double blend(double at0, double at1, double t) { return (1 - t) * at0 + t * at1; }

// The field minus the isovalue at a point of the cell. Along z first, then y, then x, like restrict_to_segment.
inline double relative_value(const CellCorners& f, const Vec3& p) {
  const double y0x0 = blend(f[0], f[4], p.z);
  const double y0x1 = blend(f[1], f[5], p.z);
  const double y1x0 = blend(f[2], f[6], p.z);
  const double y1x1 = blend(f[3], f[7], p.z);
  return blend(blend(y0x0, y1x0, p.y), blend(y0x1, y1x1, p.y), p.x);
}

// The trilinear interpolant along the segment from a to b (both in the cell's parameters, [0, 1]^3) as a cubic in the
// segment's own parameter. The cubic's blossom takes each coordinate from a or from b independently. So the Bernstein
// coefficients are averages of interpolated values at the corners of the box that a and b span. The end coefficients
// are, bit for bit, relative_value(relative, a) and relative_value(relative, b). On a face shared by two cells, both
// cells get the same values.
BernsteinCubic restrict_to_segment(const CellCorners& relative, const Vec3& a, const Vec3& b);

// The sign changes along that segment: an odd number exactly when its end values lie on different sides, zero counting
// as above. So a root on a face shared by two cells is one hit: the value there is the same from both.
SignChanges voxel_intersection(const CellCorners& relative, const Vec3& a, const Vec3& b, CubicSolver solver,
                               bool& starts_above);

}  // namespace deliso
