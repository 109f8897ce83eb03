// A ray within one voxel cell.
#pragma once

#include "delaunay/base/vec3.h"
#include "raycast/cubic_solver.h"
#include "raycast/search_options.h"
#include "volume/trilinear_cell.h"

namespace deliso {

// The field minus the isovalue at the eight corners of a cell. Its signs are exact, and interpolation keeps them: where
// all corners lie on one side, every computed value does.
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

// The trilinear interpolant along the segment from a to b (both in the cell's parameters, [0, 1]^3) as a cubic in the
// segment's own parameter. Its blossom takes each coordinate from a or from b on its own, so the Bernstein coefficients
// are averages of interpolated values at the corners of the box that a and b span. The end coefficients are, bit for
// bit, trilinear_value(relative, a) and trilinear_value(relative, b); on a face that two cells share, both cells get
// the same.
BernsteinCubic restrict_to_segment(const CellCorners& relative, const Vec3& a, const Vec3& b);

// The sign changes along that segment: an odd number exactly when its end values lie on different sides, zero counting
// as above. So a root on a face shared by two cells is one hit: the value there is the same from both.
SignChanges voxel_intersection(const CellCorners& relative, const Vec3& a, const Vec3& b, CubicSolver solver,
                               bool& starts_above);

}  // namespace deliso
