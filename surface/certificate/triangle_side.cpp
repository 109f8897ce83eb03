#include "surface/certificate/triangle_side.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

// A convex polygon: what two faces of each axis leave of a triangle has at most nine corners, but for rounding.
struct ConvexPolygon {
  std::array<Vec3, 9> corners;
  std::size_t count = 0;
  bool is_whole = true;  // no corner had to be left out

  void add(const Vec3& p) {
    is_whole = is_whole && count < corners.size();
    if (is_whole) corners.at(count++) = p;
  }
};

// Takes off what lies below a plane across an axis, and returns it.
ConvexPolygon take_below(ConvexPolygon& polygon, std::size_t axis, double plane) {
  ConvexPolygon below, above;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3 &p = polygon.corners.at(i), &q = polygon.corners.at(i + 1 < polygon.count ? i + 1 : 0);
    if (p[axis] <= plane) below.add(p);
    if (p[axis] >= plane) above.add(p);
    if ((p[axis] < plane && q[axis] > plane) || (p[axis] > plane && q[axis] < plane)) {
      const double along = (plane - p[axis]) / (q[axis] - p[axis]);
      Vec3 cut = p + along * (q - p);
      cut[axis] = plane;
      below.add(cut);
      above.add(cut);
    }
  }
  polygon = above;
  return below;
}

class SideOfParts {
 public:
  explicit SideOfParts(const Isosurface& isosurface) : isosurface_(isosurface), dims_(isosurface.grid().dims()) {}

  // Whether all of a polygon (in cells) is on the side of all before it; cut by the faces across this axis and the
  // next ones.
  bool holds(ConvexPolygon polygon, std::size_t axis) {
    if (!polygon.is_whole) return false;
    if (polygon.count < 3) return true;
    if (axis == 3) return holds_in_cell(polygon);
    double low = polygon.corners[0][axis], high = low;
    for (std::size_t i = 1; i < polygon.count; ++i) {
      low = std::min(low, polygon.corners.at(i)[axis]);
      high = std::max(high, polygon.corners.at(i)[axis]);
    }
    const double last = std::min(std::ceil(high) - 1, double(dims_[axis] - 1));
    for (double plane = std::max(std::floor(low) + 1, 0.0); plane <= last;) {
      if (!holds(take_below(polygon, axis, plane), axis + 1)) return false;
      plane += 1;
    }
    return holds(polygon, axis + 1);
  }

  [[nodiscard]] bool is_above() const { return is_above_; }

 private:
  bool agrees(double value) {
    const bool is_above = value >= 0;
    if (!is_known_) is_above_ = is_above;
    is_known_ = true;
    return is_above == is_above_;
  }

  // Beyond the box the field is that of the nearest point of the box.
  bool holds_in_cell(ConvexPolygon& polygon) {
    Vec3 middle{};
    for (std::size_t i = 0; i < polygon.count; ++i) middle += polygon.corners.at(i);
    std::array<std::int32_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = middle[axis] / static_cast<double>(polygon.count);
      cell.at(axis) = static_cast<std::int32_t>(std::clamp(at, 0.0, double(dims_[axis] - 2)));
      for (std::size_t i = 0; i < polygon.count; ++i) {
        double& x = polygon.corners.at(i)[axis];
        x = std::clamp(x, 0.0, double(dims_[axis] - 1)) - cell.at(axis);
      }
    }
    field_ = relative_to(isosurface_.grid().cell(cell[0], cell[1], cell[2]), isosurface_.isovalue());
    if (!holds_isovalue(field_)) return agrees(field_[0]);
    const auto& p = polygon.corners;
    for (std::size_t i = 2; i < polygon.count; ++i) {
      if (!holds_on(p[0], p.at(i - 1), p.at(i))) return false;
    }
    return true;
  }

  // The value of the field's blossom, which takes each coordinate from a point of its own.
  [[nodiscard]] double value(const Vec3& x, const Vec3& y, const Vec3& z) const {
    return relative_value(field_, {x.x, y.y, z.z});
  }

  // The ten Bernstein coefficients on a triangle within the cell: at corners, at edges, and in the middle.
  bool holds_on(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3* p : {&a, &b, &c}) {
      if (!agrees(value(*p, *p, *p))) return false;
    }
    const auto at_edge = [&](const Vec3& p, const Vec3& q) {
      return agrees((value(q, p, p) + value(p, q, p) + value(p, p, q)) / 3);
    };
    if (!at_edge(a, b) || !at_edge(b, a) || !at_edge(b, c) || !at_edge(c, b) || !at_edge(c, a) || !at_edge(a, c)) {
      return false;
    }
    return agrees(
        (value(a, b, c) + value(a, c, b) + value(b, a, c) + value(b, c, a) + value(c, a, b) + value(c, b, a)) / 6);
  }

  const Isosurface& isosurface_;
  const Dims& dims_;
  CellCorners field_{};  // of the cell at hand, less the isovalue
  bool is_known_ = false, is_above_ = false;
};

}  // namespace

std::optional<bool> side_of_triangle(const Isosurface& isosurface, const std::array<Vec3, 3>& corners) {
  const Vec3& step = isosurface.step();
  ConvexPolygon polygon;
  for (const Vec3& p : corners) polygon.add({p.x / step.x, p.y / step.y, p.z / step.z});
  SideOfParts sides(isosurface);
  if (!sides.holds(polygon, 0)) return std::nullopt;
  return sides.is_above();
}

}  // namespace deliso
