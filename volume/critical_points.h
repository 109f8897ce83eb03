// Critical points of the trilinear interpolant in one voxel cell: saddles of its faces and of its body. Where the
// isosurface passes one of them its topology changes, so on which side they lie tells what is joined to what.
#pragma once

#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct CriticalPoint {
  Vec3 uvw;          // in the cell's own parameters, in [0, 1]^3
  double value = 0;  // of the interpolant
};

// Appends the saddle of each face that has one inside and the saddles inside the cell (at most two). Rounded.
void append_critical_points(const CellCorners& corners, std::vector<CriticalPoint>& points);

}  // namespace deliso
