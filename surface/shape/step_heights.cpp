// How far the triangles of a step are from the isosurface, and what that may be.
#include <algorithm>
#include <cmath>
#include <limits>

#include "raycast/gradients_at.h"
#include "surface/certificate/geometry_check.h"
#include "surface/shape/step_guard.h"
#include "surface/shape/triangle_shape.h"

namespace deliso {

// Whether a triangle faces lower values as the field in some cell around its corners tells: the test of stage 2, but at
// creases, where cells meet, one of them is enough; at two corners or, in the end, at one.
bool StepGuard::faces_down(std::uint32_t triangle, const Vec3& normal) const {
  const std::array<Vec3, 3> corners = patch_.corner_points(triangle);
  const auto count = std::count_if(corners.begin(), corners.end(), [&](const Vec3& p) {
    bool is_so = false;
    for_each_gradient_at(isosurface_, p, [&](const Vec3& gradient) { is_so = is_so || dot(gradient, normal) < 0; });
    return is_so;
  });
  return count >= (freedom_ < kOneCorner ? 2 : 1);
}

// From the centroid to the isosurface where it faces as the triangle does: along the triangle's own normal, the normal
// of the triangles that were there, or down the gradient; infinity where none reaches it. No other sheet lies between,
// so thin parts are not turned inside out: the centroid is above the isovalue just where the isosurface lies ahead.
double StepGuard::height_of(std::uint32_t triangle, double reach) {
  constexpr double kFaces = 0.1;  // least cosine between a triangle's normal and the line along which it is near
  const auto [a, b, c] = patch_.corner_points(triangle);
  const Vec3 normal = cross(b - a, c - a);
  const double length = norm(normal);
  double height = std::numeric_limits<double>::infinity();
  if (!(length > 0)) return height;
  const Vec3 centroid = (a + b + c) / 3;
  const bool is_above = isosurface_.is_above(centroid);
  for (const Vec3& direction : {normal, old_normal_, -isosurface_.gradient(centroid)}) {
    const double size = norm(direction);
    if (!(size > 0) || !(dot(direction, normal) > kFaces * size * length)) continue;
    const auto hit = isosurface_.nearest_falling_hit({centroid, direction / size}, reach, counters_);
    if (hit && (*hit > 0) == is_above) height = std::min(height, std::abs(*hit));
    if (height <= kFreeDistance) break;
  }
  if (freedom_ < kSideways || height <= kFreeDistance || !faces_down(triangle, normal)) return height;
  return std::min(height, sideways_height(centroid, normal, reach));
}

// The same along lines in any direction, to the nearest hit if the isosurface does not face against the triangle there.
double StepGuard::sideways_height(const Vec3& centroid, const Vec3& normal, double reach) {
  double height = std::numeric_limits<double>::infinity();
  for (const Vec3& direction : {normal, old_normal_, isosurface_.gradient(centroid)}) {
    const double size = norm(direction);
    if (!(size > 0)) continue;
    isosurface_.all_hits({centroid, direction / size}, -reach, reach, hits_, counters_);
    const auto nearest = std::min_element(hits_.begin(), hits_.end(),
                                          [](const Hit& s, const Hit& t) { return std::abs(s.t) < std::abs(t.t); });
    if (nearest == hits_.end()) continue;
    const double facing = nearest->falling ? dot(direction, normal) : -dot(direction, normal);
    if (facing >= 0 || freedom_ >= kOneCorner) height = std::min(height, std::abs(nearest->t));
  }
  return height;
}

// In necks and at edges as thin as they are rounded, some triangles have no height: the isosurface nowhere faces as
// they do. Others like them may take their place, if they are not much larger in all and none is much longer.
bool StepGuard::lies_near(std::size_t first_added) {
  constexpr double kMuchLarger = 1.2;
  Unfaced unfaced;
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    const auto t = static_cast<std::uint32_t>(first_added + i);
    if (height_of(t, limits_[i]) <= limits_[i]) continue;
    if (freedom_ < kOneCorner) return false;
    unfaced.add(patch_.corner_points(t));
    if (unfaced.area > kMuchLarger * old_unfaced_.area || unfaced.longest > kMuchLarger * old_unfaced_.longest) {
      return false;
    }
  }
  return true;
}

// Where a distance is promised that is not much more than a triangle's height, heights of centroids do not tell.
bool StepGuard::samples_stay_near(std::size_t first_added) const {
  if (!std::isfinite(max_sample_)) return true;
  const auto is_far = [&](const std::array<Vec3, 3>& corners) {
    return count_far_samples(isosurface_, corners, max_sample_) > 0;
  };
  if (std::any_of(old_triangles_.begin(), old_triangles_.end(), is_far)) return true;
  for (std::size_t t = first_added; t < patch_.triangle_count(); ++t) {
    if (is_far(patch_.corner_points(static_cast<std::uint32_t>(t)))) return false;
  }
  return true;
}

void StepGuard::Unfaced::add(const std::array<Vec3, 3>& p) {
  area += norm(cross(p[1] - p[0], p[2] - p[0])) / 2;
  longest = std::max(longest, longest_edge(p));
}

}  // namespace deliso
