// The gradients of the field at a point. On a side of a cell there are several: the gradient jumps from cell to cell.
#pragma once

#include <cmath>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// Calls visit(gradient) for each of the cells that hold a point of mesh space, within a thousandth of their size.
template <class Visit>
void for_each_gradient_at(const Isosurface& isosurface, const Vec3& p, Visit&& visit) {
  constexpr double kOnSide = 1e-3;  // steps of the grid
  const Vec3& step = isosurface.step();
  unsigned jumps = 0;  // the axes across which another cell holds p, as bits
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double place = p[axis] / step[axis];
    if (std::abs(place - std::round(place)) < kOnSide) jumps |= 1u << axis;
  }
  for (unsigned side = 0; side < 8; ++side) {
    if ((side & ~jumps) != 0) continue;
    Vec3 q = p;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((jumps >> axis & 1u) != 0) q[axis] += ((side >> axis & 1u) != 0 ? 2 : -2) * kOnSide * step[axis];
    }
    visit(isosurface.gradient(q));
  }
}

}  // namespace deliso
