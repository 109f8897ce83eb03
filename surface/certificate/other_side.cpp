#include "surface/certificate/other_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "delaunay/base/box3.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

// The search around one point in one cell, which is [0, 1]^3 here. The interpolant is linear along each axis there, so
// a box has its extremes at its corners: where all corners are on p's side, so is the whole box.
class SideSearch {
 public:
  SideSearch(const Isosurface& isosurface, const Vec3& p, double reach)
      : isosurface_(isosurface), p_(p), squared_reach_(reach * reach), is_above_(isosurface.is_above(p)) {}

  // Whether the whole cell lies on p's side; else it is the one to search.
  [[nodiscard]] bool is_passed_over(std::int32_t i, std::int32_t j, std::int32_t k) {
    corners_ = isosurface_.grid().cell(i, j, k);
    for (double& value : corners_) value -= isosurface_.isovalue();
    first_ = {double(i), double(j), double(k)};
    return std::all_of(corners_.begin(), corners_.end(), [&](double value) { return (value >= 0) == is_above_; });
  }

  [[nodiscard]] std::optional<Vec3> finds_in(const Box3& box, int halvings) const {
    const Box3 in_mesh{place(box.low), place(box.high)};
    if (squared_distance(p_, in_mesh.clamp(p_)) > squared_reach_) return std::nullopt;
    bool has_other_side = false;
    for (unsigned corner = 0; corner < 8; ++corner) {
      if ((relative_value(corners_, corner_of(box, corner)) >= 0) == is_above_) continue;
      if (squared_distance(p_, corner_of(in_mesh, corner)) <= squared_reach_) return corner_of(in_mesh, corner);
      has_other_side = true;
    }
    if (!has_other_side || halvings == 0) return std::nullopt;
    const Vec3 middle = 0.5 * (box.low + box.high);
    for (unsigned octant = 0; octant < 8; ++octant) {
      Box3 part{middle, middle};
      part.extend(corner_of(box, octant));
      if (const std::optional<Vec3> found = finds_in(part, halvings - 1)) return found;
    }
    return std::nullopt;
  }

 private:
  static Vec3 corner_of(const Box3& box, unsigned i) {
    return {((i & 1u) != 0 ? box.high : box.low).x, ((i & 2u) != 0 ? box.high : box.low).y,
            ((i & 4u) != 0 ? box.high : box.low).z};
  }
  [[nodiscard]] Vec3 place(const Vec3& in_cell) const { return scaled(isosurface_.step(), first_ + in_cell); }

  const Isosurface& isosurface_;
  const Vec3& p_;
  double squared_reach_;
  bool is_above_;
  CellCorners corners_{};  // the field minus the isovalue
  Vec3 first_;             // the cell's low corner
};

}  // namespace

std::optional<Vec3> other_side_within(const Isosurface& isosurface, const Vec3& p, double reach, int halvings) {
  SideSearch search(isosurface, p, reach);
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
        if (search.is_passed_over(std::int32_t(i), std::int32_t(j), std::int32_t(k))) continue;
        const auto in_cell = [&](const Vec3& q) {
          const Vec3 x{q.x / step.x - double(i), q.y / step.y - double(j), q.z / step.z - double(k)};
          return Box3{{0, 0, 0}, {1, 1, 1}}.clamp(x);
        };
        if (const auto found = search.finds_in({in_cell(low), in_cell(high)}, halvings)) return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace deliso
