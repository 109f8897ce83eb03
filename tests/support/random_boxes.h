// Boxes for tests of what orders and searches them.
#pragma once

#include <cstddef>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/rng.h"

namespace deliso::testing {

// With their low corners in the unit cube and sides of at most `side`.
inline std::vector<Box3> random_boxes(Rng& rng, std::size_t count, double side) {
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    const Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
    box.extend(p);
    box.extend(p + side * Vec3{rng.uniform(), rng.uniform(), rng.uniform()});
  }
  return boxes;
}

inline bool have_common_point(const Box3& a, const Box3& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

}  // namespace deliso::testing
