// Critical points of the trilinear interpolant: saddles of the faces and of the body of a voxel cell, and samples.
// Where the isosurface passes one of them its topology changes, so on which side they lie tells what is joined to what.
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

// On which side of the isovalue a saddle lies: 1 above, -1 below, 0 on it. Exact for saddles of faces; for those of the
// body 0 also when rounding could decide.
int side_of_saddle(const CellCorners& corners, double isovalue, const CriticalPoint& saddle);

// Which corners of a cell (bit i + 2j + 4k) are extrema or saddles of the interpolant. Near a sample the interpolant is
// linear in every octant, so the signs of the differences to the six neighbours decide: those above it (or those below
// it) are none, or just two opposite ones, which no path around the sample joins. Ties are broken by index.
unsigned critical_corners(const ScalarGrid& grid, const std::array<std::int32_t, 3>& cell);

}  // namespace deliso
