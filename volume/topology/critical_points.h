// Critical points of the trilinear interpolant: saddles of the faces and of the body of a voxel cell, and samples. The
// topology of the isosurface changes when the isovalue passes their value. So the side on which they lie tells which
// parts of the surface are joined.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct CriticalPoint {
  Vec3 uvw;          // in the cell's own parameters, in [0, 1]^3
  double value = 0;  // of the interpolant
  int face = -1;     // 2 axis + side; -1 for a saddle of the body
};

// Appends the saddle of each face that has one inside and the saddles inside the cell (at most two). Rounded.
void append_critical_points(const CellCorners& corners, std::vector<CriticalPoint>& points);

// On which side of the isovalue a saddle lies: 1 above, -1 below, 0 on it. Exact for saddles of faces. For saddles of
// the body 0 also means that rounding leaves the side undecided.
int side_of_saddle(const CellCorners& corners, double isovalue, const CriticalPoint& saddle);

// Which corners of a cell (bit i + 2j + 4k) are extrema or saddles of the interpolant. Near a sample the interpolant is
// linear in every octant, so the signs of the differences to the six neighbours decide. The sample is critical when no
// neighbour lies above it, or when only two opposite neighbours do, which no path around the sample joins; the same
// with below. Ties are broken by index.
unsigned critical_corners(const ScalarGrid& grid, const std::array<std::int32_t, 3>& cell);

}  // namespace deliso
