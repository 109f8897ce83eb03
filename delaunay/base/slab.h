// A slab of space: volumes are cut into slabs so that threads can work on them independently.
#pragma once

#include <cstddef>
#include <limits>

#include "delaunay/base/vec3.h"

namespace deliso {

// The open region between two planes across an axis.
struct Slab {
  std::size_t axis = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(const Vec3& p) const { return low < p[axis] && p[axis] < high; }
};

}  // namespace deliso
