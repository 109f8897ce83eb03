#include "surface/sample_locator.h"

#include <algorithm>
#include <cstdint>

#include "delaunay/predicates.h"

namespace deliso {

SampleLocator::SampleLocator(const SignedDelaunay& restricted, const ScalarGrid& grid)
    : restricted_(restricted), grid_(grid), known_(std::size_t{1} << kBits) {}

SampleLocator::Located SampleLocator::locate_settled(const std::array<std::int32_t, 3>& sample, TetId hint) {
  const std::size_t index = grid_.index(sample[0], sample[1], sample[2]);
  Known& known = known_[(index * std::uint64_t{0x9E3779B97F4A7C15}) >> (64 - kBits)];
  if (known.sample == index) return {known.tet, true};
  const Located located = locate_settled(place(sample), hint);
  if (located.is_settled) known = {index, located.tet};
  return located;
}

bool SampleLocator::is_strictly_inside(TetId t, const Vec3& p) const {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  if (delaunay.is_ghost(t)) return false;
  const auto& v = delaunay.vertices(t);
  return std::all_of(std::begin(kFacetSlots), std::end(kFacetSlots), [&](const auto& slots) {
    return orient3d(delaunay.point(v[slots[0]]), delaunay.point(v[slots[1]]), delaunay.point(v[slots[2]]), p) < 0;
  });
}

}  // namespace deliso
