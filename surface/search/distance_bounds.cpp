#include "surface/search/distance_bounds.h"

#include <algorithm>
#include <cmath>

namespace deliso {

namespace {

constexpr float kInfinite = 1e30F;
// For a triangle whose smallest angle has a sine below 2 divided by this, no bounds are given: the stretch would
// magnify the rounding. With a still smaller angle the triangle has no plane.
constexpr double kMostStretch = 100;
constexpr double kFlat = 1e6;

Quad quad(double x) { return Quad{} + static_cast<float>(x); }
Quad less(const Quad& a, const Quad& b) { return b < a ? b : a; }
Quad greater(const Quad& a, const Quad& b) { return a < b ? b : a; }

}  // namespace

TrianglePlanes::Plane TrianglePlanes::plane(const Vec3& normal, const Vec3& offset) {
  return {quad(normal.x), quad(normal.y), quad(normal.z), quad(dot(normal, offset))};
}

TrianglePlanes::TrianglePlanes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& middle)
    : unknown_(quad(kInfinite)) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double squared_ab = squared_norm(ab), squared_bc = squared_norm(bc), squared_ca = squared_norm(ca);
  const double shortest = std::min({squared_ab, squared_bc, squared_ca});
  const Vec3 normal = cross(ab, bc);
  const double squared_area = squared_norm(normal);
  // 2 over the sine of the smallest angle.
  const double squared_stretch = 4 * (squared_ab * squared_bc * squared_ca) / (shortest * squared_area);
  if (!(squared_stretch < kFlat * kFlat)) return;
  const Vec3 unit = normal / std::sqrt(squared_area);
  const auto side = [&](const Vec3& edge, double squared_length, const Vec3& through) {
    return plane(cross(edge, unit) / std::sqrt(squared_length), middle - through);
  };
  own_ = plane(unit, middle - a);
  sides_ = {side(ab, squared_ab, a), side(bc, squared_bc, b), side(ca, squared_ca, c)};
  if (squared_stretch > kMostStretch * kMostStretch) return;
  squared_stretch_ = quad(squared_stretch);
  unknown_ = Quad{};
}

DistanceBounds::DistanceBounds(std::span<const Vec3> points, const Vec3& middle) : quads_((points.size() + 3) / 4) {
  for (std::size_t i = 0; i < 4 * quads_; ++i) {
    const Vec3 p = points[std::min(i, points.size() - 1)] - middle;
    x_[i / 4][i % 4] = static_cast<float>(p.x);
    y_[i / 4][i % 4] = static_cast<float>(p.y);
    z_[i / 4][i % 4] = static_cast<float>(p.z);
  }
  least_.fill(quad(kInfinite));
  most_.fill(quad(kInfinite));
}

// The bounds use a point's height above the triangle's plane, and how far the point lies beyond the lines of the sides.
// In the plane this is a lower bound of its distance from the triangle. The distance is at most this times the factor
// by which the corner with the smallest angle moves when all sides move outward: 1 over the sine of half that angle,
// which is less than the stretch.
void DistanceBounds::add(const TrianglePlanes& planes) {
  const auto& [first, second, third] = planes.sides_;
  for (std::size_t i = 0; i < quads_; ++i) {
    const Quad x = x_[i], y = y_[i], z = z_[i];
    const Quad height = planes.own_(x, y, z);
    const Quad out = greater(greater(first(x, y, z), second(x, y, z)), greater(third(x, y, z), Quad{}));
    const Quad squared_out = out * out, squared_height = height * height;
    least_[i] = less(squared_height + squared_out, least_[i]);
    most_[i] = less(squared_height + (planes.squared_stretch_ * squared_out + planes.unknown_), most_[i]);
  }
}

}  // namespace deliso
