#include "experiments/pictures/shape.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"

namespace deliso {
namespace {

constexpr char kAxisNames[] = "xyz";

InputError nothing_left(const ClipPlane& plane, const Box3& whole, const std::string& option) {
  const std::size_t a = plane.axis;
  const std::string name(1, kAxisNames[a]);
  return InputError(option + ": " + name + "=" + number_text(plane.value) + " leaves nothing to see, " + name +
                    " goes from " + number_text(whole.low[a]) + " to " + number_text(whole.high[a]));
}

}  // namespace

ClipPlane parse_clip_plane(const std::string& text, const std::string& option) {
  const std::size_t axis = text.empty() ? std::string::npos : std::string(kAxisNames).find(text[0]);
  if (axis == std::string::npos || text.size() < 2 || text[1] != '=') {
    throw InputError(option + ": expected x=V, y=V or z=V, found '" + text + "'");
  }
  return {axis, parse_number(text.substr(2), option, text)};
}

Box3 kept_box(const Box3& whole, const std::vector<ClipPlane>& planes, const Vec3& toward_eye,
              const std::string& option) {
  const double air = 1e-6 * whole.diagonal();
  Box3 kept{whole.low - Vec3{air, air, air}, whole.high + Vec3{air, air, air}};
  for (const ClipPlane& plane : planes) {
    const std::size_t a = plane.axis;
    if (toward_eye[a] >= 0) {
      kept.high[a] = std::min(kept.high[a], plane.value);
    } else {
      kept.low[a] = std::max(kept.low[a], plane.value);
    }
    if (std::max(kept.low[a], whole.low[a]) < std::min(kept.high[a], whole.high[a])) continue;
    throw nothing_left(plane, whole, option);
  }
  return kept;
}

std::optional<RayPart> part_in_box(const Line& ray, const Box3& box) {
  RayPart part{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t a = 0; a < 3; ++a) {
    if (ray.direction[a] == 0) {
      if (ray.origin[a] < box.low[a] || ray.origin[a] > box.high[a]) return std::nullopt;
      continue;
    }
    const double at_low = (box.low[a] - ray.origin[a]) / ray.direction[a];
    const double at_high = (box.high[a] - ray.origin[a]) / ray.direction[a];
    part.first = std::max(part.first, std::min(at_low, at_high));
    part.last = std::min(part.last, std::max(at_low, at_high));
  }
  if (!(part.first <= part.last)) return std::nullopt;
  return part;
}

}  // namespace deliso
