#include "surface/founded_signs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/predicates.h"

namespace deliso {

namespace {

constexpr std::size_t kLargestPocket = 100;

bool holds(const SignedDelaunay& restricted, TetId t, const Vec3& p) {
  const auto& v = restricted.delaunay().vertices(t);
  for (const auto& slots : kFacetSlots) {
    const Vec3& a = restricted.delaunay().point(v[slots[0]]);
    const Vec3& b = restricted.delaunay().point(v[slots[1]]);
    const Vec3& c = restricted.delaunay().point(v[slots[2]]);
    if (orient3d(a, b, c, p) > 0) return false;  // beyond a facet
  }
  return true;
}

// Whether a tetrahedron holds a sample on the side of its sign.
bool is_founded(const SignedDelaunay& restricted, const ScalarGrid& grid, TetId t) {
  const Isosurface& isosurface = restricted.isosurface();
  const Vec3& step = isosurface.step();
  Box3 box;
  for (const VertexId v : restricted.delaunay().vertices(t)) box.extend(restricted.delaunay().point(v));
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = static_cast<std::int32_t>(std::max(0.0, std::ceil(box.low[axis] / step[axis])));
    high[axis] = static_cast<std::int32_t>(std::min(grid.dims()[axis] - 1.0, std::floor(box.high[axis] / step[axis])));
  }
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) {
        if ((grid.at(i, j, k) > isosurface.isovalue()) != restricted.is_above(t)) continue;
        const Vec3 sample{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        if (holds(restricted, t, scaled(sample, step))) return true;
      }
    }
  }
  return false;
}

}  // namespace

std::int64_t overturn_unfounded_signs(SignedDelaunay& restricted, const ScalarGrid& grid) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  std::vector<bool> seen(delaunay.tet_slots(), false);
  std::vector<TetId> pocket;
  std::vector<TetId> unfounded;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    if (seen[i] || !delaunay.is_live(TetId(i))) continue;
    // The face-connected set of tetrahedra of one sign.
    pocket.assign(1, TetId(i));
    seen[i] = true;
    bool has_ghost = false;
    for (std::size_t at = 0; at < pocket.size(); ++at) {
      has_ghost |= delaunay.is_ghost(pocket[at]);
      for (unsigned face = 0; face < 4; ++face) {
        const TetId next = delaunay.neighbour(pocket[at], face);
        if (seen[next.index()] || restricted.is_above(next) != restricted.is_above(pocket[at])) continue;
        seen[next.index()] = true;
        pocket.push_back(next);
      }
    }
    if (has_ghost || pocket.size() > kLargestPocket) continue;
    if (std::any_of(pocket.begin(), pocket.end(), [&](TetId t) { return is_founded(restricted, grid, t); })) continue;
    unfounded.insert(unfounded.end(), pocket.begin(), pocket.end());
    ++count;
  }
  for (const TetId t : unfounded) restricted.overturn_sign(t);
  return count;
}

}  // namespace deliso
