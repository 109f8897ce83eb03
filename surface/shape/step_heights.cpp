// Whether the triangles of a step are as near to the isosurface as they have to be.
#include <algorithm>
#include <cmath>

#include "surface/certificate/triangle_nearness.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/shape/step_guard.h"
#include "surface/shape/triangle_heights.h"

namespace deliso {

// In necks and at edges as thin as they are rounded, some triangles have no height: the isosurface nowhere faces as
// they do. Others like them may take their place, if they are not much larger in all and none is much longer.
bool StepGuard::lies_near(std::size_t first_added) {
  constexpr double kMuchLarger = 1.2;
  Unfaced unfaced;
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    const auto t = static_cast<std::uint32_t>(first_added + i);
    if (heights_.of(t, limits_[i]) <= limits_[i]) continue;
    unfaced.add(patch_.corner_points(t));
    if (freedom_ >= kOneCorner && unfaced.area <= kMuchLarger * old_unfaced_.area &&
        unfaced.longest <= kMuchLarger * old_unfaced_.longest) {
      continue;
    }
    if (!may_be_far_) return false;
    far_.push_back(t);
  }
  return true;
}

// Where a distance is promised that is not much more than a triangle's height, heights of centroids do not tell. What
// takes the place of a triangle that is too far may be so, too, but then it counts as the worst of all.
bool StepGuard::samples_stay_near(std::size_t first_added) {
  if (!std::isfinite(max_sample_)) return true;
  const auto is_far = [&](const std::array<Vec3, 3>& corners) {
    return count_far_parts(isosurface_, corners, max_sample_, 1) > 0;
  };
  const bool may_be_far = std::any_of(old_triangles_.begin(), old_triangles_.end(), is_far);
  for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
    if (!is_far(patch_.corner_points(t))) continue;
    if (!may_be_far) return false;
    patch_.spoil(t);
  }
  return true;
}

void StepGuard::Unfaced::add(const std::array<Vec3, 3>& p) {
  area += norm(cross(p[1] - p[0], p[2] - p[0])) / 2;
  longest = std::max(longest, longest_edge(p));
}

}  // namespace deliso
