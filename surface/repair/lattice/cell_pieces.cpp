#include "surface/repair/lattice/cell_pieces.h"

#include <cstddef>

namespace deliso {

std::array<std::int32_t, 3> cell_pieces(const Isosurface& isosurface) {
  constexpr double kLongest = 1.5;
  constexpr std::int32_t kMost = 63;
  std::array<std::int32_t, 3> pieces = {1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t& along = pieces[axis];
    const auto fits = [&](std::int32_t count) {
      return (std::int64_t{isosurface.grid().dims()[axis]} * count * kFinestParts) >> kCoordinateBits == 0;
    };
    while (along < kMost && isosurface.step()[axis] > kLongest * along && fits(along + 2)) along += 2;
  }
  return pieces;
}

}  // namespace deliso
