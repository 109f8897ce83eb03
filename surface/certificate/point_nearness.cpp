#include "surface/certificate/point_nearness.h"

#include <cmath>

#include "raycast/gradients_at.h"
#include "surface/certificate/other_side.h"

namespace deliso {

namespace {

// The likelier side first.
std::optional<Vec3> point_across_along(const Isosurface& isosurface, const Vec3& p, bool is_above, const Vec3& falling,
                                       double distance) {
  const double length = norm_of_any_size(falling);
  // Of a gradient that is all but zero the quotient overflows: it is no direction.
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(distance / length)) return std::nullopt;
  const Vec3 offset = ((is_above ? distance : -distance) / length) * falling;
  if (isosurface.is_above(p + offset) != is_above) return p + offset;
  if (isosurface.is_above(p - offset) != is_above) return p - offset;
  return std::nullopt;
}

}  // namespace

bool changes_side(const Isosurface& isosurface, const Vec3& p, bool is_above, const Vec3& falling, double distance) {
  return point_across_along(isosurface, p, is_above, falling, distance).has_value();
}

std::optional<Vec3> point_across(const Isosurface& isosurface, const Vec3& p, const Vec3& falling, double reach,
                                 int halvings) {
  constexpr double kBeyond = 1.01;
  const bool is_above = isosurface.is_above(p);
  const auto across = [&](const Vec3& direction, double distance) {
    return point_across_along(isosurface, p, is_above, direction, distance);
  };
  if (const auto found = across(falling, reach)) return found;
  if (const auto found = across(-isosurface.gradient(p), reach)) return found;
  // As far as the values around p say that the isosurface lies, in each of its cells: just beyond that.
  std::optional<Vec3> found;
  const double value = std::abs(isosurface.value(p));
  for_each_gradient_at(isosurface, p, [&](const Vec3& gradient) {
    for (const Vec3& direction : {gradient, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const double distance = kBeyond * value * norm_of_any_size(direction) / std::abs(dot(gradient, direction));
      if (!found && distance <= reach) found = across(direction, distance);
    }
  });
  return found ? found : other_side_within(isosurface, p, reach, halvings);
}

bool is_shown_within(const Isosurface& isosurface, const Vec3& p, double distance) {
  return isosurface.passes_within(p, distance) || isosurface.value(p) == 0 ||
         point_across(isosurface, p, -isosurface.gradient(p), distance).has_value();
}

}  // namespace deliso
