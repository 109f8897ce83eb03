#include "surface/sample_locator.h"

#include <cstdint>

namespace deliso {

SampleLocator::SampleLocator(const SignedDelaunay& restricted, const ScalarGrid& grid)
    : restricted_(restricted), grid_(grid), known_(std::size_t{1} << kBits) {}

TetId SampleLocator::locate(const std::array<std::int32_t, 3>& sample, TetId hint) {
  const std::size_t index = grid_.index(sample[0], sample[1], sample[2]);
  Known& known = known_[(index * std::uint64_t{0x9E3779B97F4A7C15}) >> (64 - kBits)];
  if (known.sample == index) return known.tet;
  const Vec3 p = place(sample);
  const TetId t = restricted_.locate(p, hint);
  if (!restricted_.delaunay().is_ghost(t)) known = {index, t};
  return t;
}

}  // namespace deliso
