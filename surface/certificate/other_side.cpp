#include "surface/certificate/other_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "delaunay/base/box3.h"

namespace deliso {

namespace {

constexpr int kHalvings = 10;

// The search around one point. Within a cell the interpolant is linear along each axis, so a box has its extremes at
// its corners: where all corners are on p's side, so is the whole box.
class SideSearch {
 public:
  SideSearch(const Isosurface& isosurface, const Vec3& p, double reach)
      : isosurface_(isosurface), p_(p), squared_reach_(reach * reach), is_above_(isosurface.is_above(p)) {}

  // Precondition: the box lies within a cell.
  [[nodiscard]] bool finds_in(const Box3& box, int halvings) const {
    if (squared_distance(p_, box.clamp(p_)) > squared_reach_) return false;
    bool has_other_side = false;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3 x = corner_of(box, corner);
      if (isosurface_.is_above(x) == is_above_) continue;
      if (squared_distance(p_, x) <= squared_reach_) return true;
      has_other_side = true;
    }
    if (!has_other_side || halvings == 0) return false;
    const Vec3 middle = 0.5 * (box.low + box.high);
    for (unsigned octant = 0; octant < 8; ++octant) {
      Box3 part{middle, middle};
      part.extend(corner_of(box, octant));
      if (finds_in(part, halvings - 1)) return true;
    }
    return false;
  }

 private:
  static Vec3 corner_of(const Box3& box, unsigned i) {
    return {((i & 1u) != 0 ? box.high : box.low).x, ((i & 2u) != 0 ? box.high : box.low).y,
            ((i & 4u) != 0 ? box.high : box.low).z};
  }

  const Isosurface& isosurface_;
  const Vec3& p_;
  double squared_reach_;
  bool is_above_;
};

}  // namespace

bool has_other_side_within(const Isosurface& isosurface, const Vec3& p, double reach) {
  const SideSearch search(isosurface, p, reach);
  const Box3& box = isosurface.box();
  const Vec3& step = isosurface.step();
  const Vec3 low = box.clamp(p - Vec3{reach, reach, reach}), high = box.clamp(p + Vec3{reach, reach, reach});
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t most = std::llround(box.high[axis] / step[axis]) - 1;
    first[axis] = std::clamp(static_cast<std::int64_t>(std::floor(low[axis] / step[axis])), std::int64_t{0}, most);
    last[axis] = std::clamp(static_cast<std::int64_t>(std::floor(high[axis] / step[axis])), first[axis], most);
  }
  for (std::int64_t k = first[2]; k <= last[2]; ++k) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      for (std::int64_t i = first[0]; i <= last[0]; ++i) {
        const Vec3 corner = scaled(step, {double(i), double(j), double(k)});
        const Box3 cell{corner, scaled(step, {double(i + 1), double(j + 1), double(k + 1)})};
        const Box3 part{cell.clamp(low), cell.clamp(high)};
        if (search.finds_in(part, kHalvings)) return true;
      }
    }
  }
  return false;
}

}  // namespace deliso
