#include "surface/certificate/cells/surface_hull.h"

#include <cmath>

namespace deliso {

SurfaceHull::SurfaceHull(const PartOfCell& part) {
  // As a sum of products of the coordinates along some axes, each from -1 to 1.
  CellCorners terms = part.values;
  for (std::size_t axis = 1; axis < 8; axis *= 2) {
    for (std::size_t i = 0; i < 8; ++i) {
      if ((i & axis) != 0) continue;
      const double low = terms[i], high = terms[i | axis];
      terms[i] = (low + high) / 2;
      terms[i | axis] = (high - low) / 2;
    }
  }
  constexpr double kOfSums = 0x1p-48;  // rounding, of sums of eight values
  double all = 0;
  for (const double value : part.values) all += std::abs(value);
  const double most = std::abs(terms[3]) + std::abs(terms[5]) + std::abs(terms[6]) + std::abs(terms[7]) + kOfSums * all;
  rise_ = {terms[1], terms[2], terms[4]};
  CellCorners linear{};
  for (unsigned i = 0; i < 8; ++i) {
    linear[i] = terms[0] + ((i & 1u) != 0 ? terms[1] : -terms[1]) + ((i & 2u) != 0 ? terms[2] : -terms[2]) +
                ((i & 4u) != 0 ? terms[4] : -terms[4]);
    if (std::abs(linear[i]) <= most) add(corner_of(part.box, i));
  }
  for (unsigned from = 0; from < 8; ++from) {
    for (unsigned axis = 1; axis < 8; axis *= 2) {
      if ((from & axis) != 0) continue;
      for (const double level : {-most, most}) {
        const double below = linear[from] - level, above = linear[from | axis] - level;
        if ((below < 0) == (above < 0)) continue;
        const Vec3 a = corner_of(part.box, from), b = corner_of(part.box, from | axis);
        add(a + (below / (below - above)) * (b - a));
      }
    }
  }
}

}  // namespace deliso
