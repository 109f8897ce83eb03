// The trilinear interpolant of one voxel cell, in the cell's own parameters (u, v, w) in [0, 1]^3.
#pragma once

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// g(u, v, w) = c[0] + c[1] u + c[2] v + c[3] uv + c[4] w + c[5] uw + c[6] vw + c[7] uvw. Values at the corners and
// along the cell's edges come out the same from every cell that shares them (they are computed by interpolation, not
// from c).
double trilinear_value(const CellCorners& corners, const Vec3& uvw);
// Its gradient with respect to (u, v, w).
Vec3 trilinear_gradient(const CellCorners& corners, const Vec3& uvw);

}  // namespace deliso
