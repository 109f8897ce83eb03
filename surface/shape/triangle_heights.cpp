#include "surface/shape/triangle_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raycast/gradients_at.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {

// Whether a triangle faces lower values as the field in some cell around its corners tells: the test of stage 2, but at
// creases, where cells meet, one of them is enough; at two corners or, in the end, at one.
bool TriangleHeights::faces_down(std::uint32_t triangle, const Vec3& normal) const {
  const std::array<Vec3, 3> corners = patch_.corner_points(triangle);
  const auto count = std::count_if(corners.begin(), corners.end(), [&](const Vec3& p) {
    bool is_so = false;
    for_each_gradient_at(isosurface_, p, [&](const Vec3& gradient) { is_so = is_so || dot(gradient, normal) < 0; });
    return is_so;
  });
  return count >= (freedom_ < kOneCorner ? 2 : 1);
}

// With much freedom, whether a height may be along any line.
bool TriangleHeights::goes_sideways(double height, std::uint32_t triangle, const Facing& facing) const {
  return freedom_ >= kSideways && height > kFreeDistance && faces_down(triangle, facing.normal);
}

// From the centroid to the isosurface where it faces as the triangle does: along the triangle's own normal, the normal
// of the triangles that were there, or down the gradient; infinity where none reaches it. No other sheet lies between,
// so thin parts are not turned inside out: the centroid is above the isovalue just where the isosurface lies ahead.
double TriangleHeights::of(std::uint32_t triangle, double reach) {
  const Facing facing = facing_of(patch_.corner_points(triangle));
  if (!(facing.length > 0)) return std::numeric_limits<double>::infinity();
  double height = height_along(facing, facing.normal, reach);
  if (height > kFreeDistance) height = std::min(height, height_along(facing, old_normal_, reach));
  if (height > kFreeDistance) {
    height = std::min(height, height_along(facing, -isosurface_.gradient(facing.centroid), reach));
  }
  if (!goes_sideways(height, triangle, facing)) return height;
  return std::min(height, sideways_height(facing, own_hits(facing, reach), reach));
}

// The same of a triangle in place, as far as its longest edge reaches.
double TriangleHeights::of_placed(std::uint32_t triangle) {
  const std::array<Vec3, 3> corners = patch_.corner_points(triangle);
  const Facing facing = facing_of(corners);
  if (!(facing.length > 0)) return std::numeric_limits<double>::infinity();
  const double reach = longest_edge(corners);
  Known& known = known_[triangle];
  if (known.corners != corners) {
    known = {corners, height_along(facing, facing.normal, reach), std::nullopt, std::nullopt};
  }
  double height = known.along_normal;
  if (height > kFreeDistance) height = std::min(height, height_along(facing, old_normal_, reach));
  if (height > kFreeDistance) {
    if (!known.down_gradient) {
      known.down_gradient = height_along(facing, -isosurface_.gradient(facing.centroid), reach);
    }
    height = std::min(height, *known.down_gradient);
  }
  if (!goes_sideways(height, triangle, facing)) return height;
  if (!known.own_hits) known.own_hits = own_hits(facing, reach);
  return std::min(height, sideways_height(facing, *known.own_hits, reach));
}

TriangleHeights::Facing TriangleHeights::facing_of(const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  Facing facing{(a + b + c) / 3, cross(b - a, c - a)};
  facing.length = norm(facing.normal);
  return facing;
}

double TriangleHeights::height_along(const Facing& facing, const Vec3& direction, double reach) {
  constexpr double kFaces = 0.1;  // least cosine between a triangle's normal and the line along which it is near
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double size = norm(direction);
  if (!(size > 0) || !(dot(direction, facing.normal) > kFaces * size * facing.length)) return kNone;
  const auto hit = isosurface_.nearest_falling_hit({facing.centroid, direction / size}, reach, counters_);
  return hit && (*hit > 0) == isosurface_.is_above(facing.centroid) ? std::abs(*hit) : kNone;
}

TriangleHeights::NearHit TriangleHeights::near_hit(const Vec3& centroid, const Vec3& direction, double reach) {
  const double size = norm(direction);
  if (!(size > 0)) return {direction, std::nullopt};
  isosurface_.all_hits({centroid, direction / size}, -reach, reach, hits_, counters_);
  const auto nearest = std::min_element(hits_.begin(), hits_.end(),
                                        [](const Hit& s, const Hit& t) { return std::abs(s.t) < std::abs(t.t); });
  return {direction, nearest == hits_.end() ? std::nullopt : std::optional(*nearest)};
}

// Along the triangle's own normal and the gradient.
std::array<TriangleHeights::NearHit, 2> TriangleHeights::own_hits(const Facing& facing, double reach) {
  return {near_hit(facing.centroid, facing.normal, reach),
          near_hit(facing.centroid, isosurface_.gradient(facing.centroid), reach)};
}

// The height along lines in any direction, to the nearest hit if the isosurface does not face against the triangle
// there.
double TriangleHeights::sideways_height(const Facing& facing, const std::array<NearHit, 2>& own, double reach) {
  double height = std::numeric_limits<double>::infinity();
  for (const auto& [direction, hit] : {own[0], near_hit(facing.centroid, old_normal_, reach), own[1]}) {
    if (!hit) continue;
    const double cosine = hit->falling ? dot(direction, facing.normal) : -dot(direction, facing.normal);
    if (cosine >= 0 || freedom_ >= kOneCorner) height = std::min(height, std::abs(hit->t));
  }
  return height;
}

}  // namespace deliso
