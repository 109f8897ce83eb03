// A slab of space, as volumes are cut into parts that threads work on apart from each other.
#pragma once

#include <cstddef>
#include <limits>

#include "delaunay/base/vec3.h"

namespace deliso {

// What lies strictly between two planes across an axis.
struct Slab {
  std::size_t axis = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(const Vec3& p) const { return low < p[axis] && p[axis] < high; }
};

}  // namespace deliso
