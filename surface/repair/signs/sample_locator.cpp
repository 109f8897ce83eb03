#include "surface/repair/signs/sample_locator.h"

#include <cstdint>

namespace deliso {

SampleLocator::SampleLocator(const SignedDelaunay& restricted, const ScalarGrid& grid)
    : restricted_(restricted), grid_(grid), known_(std::size_t{1} << kBits) {}

TetId SampleLocator::locate(const std::array<std::int32_t, 3>& cell, unsigned corner, TetId hint) {
  std::array<std::int32_t, 3> sample = cell;
  Vec3 p;
  Vec3 center;
  for (unsigned axis = 0; axis < 3; ++axis) {
    sample[axis] += static_cast<std::int32_t>(corner >> axis & 1u);
    p[axis] = sample[axis];
    center[axis] = cell[axis] + 0.5;
  }
  const std::size_t index = grid_.index(sample[0], sample[1], sample[2]);
  Known& known = known_[(index * std::uint64_t{0x9E3779B97F4A7C15}) >> (64 - kBits)];
  if (known.sample == index) {
    if (known.corner == corner) return known.tet;
    hint = known.tet;
  }
  const Vec3& step = restricted_.isosurface().step();
  const TetId t = restricted_.locate(scaled(p, step), scaled(center, step), hint);
  if (!restricted_.delaunay().is_ghost(t)) known = {index, corner, t};
  return t;
}

}  // namespace deliso
