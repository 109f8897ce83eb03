// The probe's complete search of a ball.
#include <algorithm>
#include <array>
#include <optional>

#include "surface/verification/isosurface_probe.h"

namespace deliso {

namespace {

// Corner i: bit a of i says whether it lies at the high end of axis a.
Vec3 corner_of_part(const Box3& box, unsigned i) {
  return {((i & 1u) != 0 ? box.high : box.low).x, ((i & 2u) != 0 ? box.high : box.low).y,
          ((i & 4u) != 0 ? box.high : box.low).z};
}

}  // namespace

// A point of a box on the other side of the isosurface than p, within `reach` of p. Precondition: the box lies within a
// cell. See look_in_box for why its corners tell of all of it.
std::optional<Vec3> IsosurfaceProbe::other_side_in(const Vec3& p, const Box3& box, double reach, int halvings) const {
  if (deliso::distance(p, box.clamp(p)) > reach) return std::nullopt;
  const bool is_below = value(p) < 0;
  bool has_other_side = false;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 x = corner_of_part(box, corner);
    if ((value(x) < 0) == is_below) continue;
    if (deliso::distance(p, x) <= reach) return x;
    has_other_side = true;
  }
  if (!has_other_side || halvings == 0) return std::nullopt;
  const Vec3 middle = 0.5 * (box.low + box.high);
  for (unsigned octant = 0; octant < 8; ++octant) {
    Box3 part{middle, middle};
    part.extend(corner_of_part(box, octant));
    if (const auto found = other_side_in(p, part, reach, halvings - 1)) return found;
  }
  return std::nullopt;
}

// Searches the ball around p completely, but for points that are all but on its boundary.
std::optional<FootPoint> IsosurfaceProbe::foot_within(const Vec3& p, double reach) const {
  constexpr int kHalvings = 12;
  const Vec3 low = box_.clamp(p - Vec3{reach, reach, reach}), high = box_.clamp(p + Vec3{reach, reach, reach});
  std::array<int, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::min(static_cast<int>(low[axis] / step_[axis]), grid_.dims()[axis] - 2);
    last[axis] = std::min(static_cast<int>(high[axis] / step_[axis]), grid_.dims()[axis] - 2);
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const Box3 cell{scaled(step_, {double(i), double(j), double(k)}),
                        scaled(step_, {double(i + 1), double(j + 1), double(k + 1)})};
        const auto beyond = other_side_in(p, {cell.clamp(low), cell.clamp(high)}, reach, kHalvings);
        if (!beyond) continue;
        // On the way to this point the isosurface is crossed, at the latest within rounding of it.
        const double length = deliso::distance(p, *beyond);
        if (!(length > 0)) return FootPoint{p, 0};
        return along_line(p, value(p), (*beyond - p) / length, length, length).value_or(FootPoint{*beyond, length});
      }
    }
  }
  return std::nullopt;
}

}  // namespace deliso
