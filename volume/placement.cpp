#include "volume/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

namespace {

constexpr std::string_view kLps = "left-posterior-superior";
constexpr std::string_view kRas = "right-anterior-superior";
constexpr std::string_view kLas = "left-anterior-superior";

// The signs of x, y, z against LPS.
std::optional<Vec3> signs_of(std::string_view space) {
  if (space == kLps) return Vec3{1, 1, 1};
  if (space == kRas) return Vec3{-1, -1, 1};
  if (space == kLas) return Vec3{1, -1, 1};
  return std::nullopt;
}

std::string text_of(const Vec3& v) {
  return "(" + shortest_text(v.x) + ", " + shortest_text(v.y) + ", " + shortest_text(v.z) + ")";
}

// Along its own axis, forwards.
bool is_along(const Vec3& direction, std::size_t axis) {
  return direction[axis] > 0 && direction[(axis + 1) % 3] == 0 && direction[(axis + 2) % 3] == 0;
}

void check_directions(const Affine& map) {
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = norm_of_any_size(map.columns[axis]);
    if (!(length >= kSmallest && length <= kLargest)) {
      throw InputError("the direction of axis " + std::to_string(axis) + " is " + text_of(map.columns[axis]) +
                       ": its length, the spacing, must be from 1e-100 to 1e100");
    }
  }
  if (!is_finite(map.offset)) throw InputError("the origin is " + text_of(map.offset) + ": it must be finite");
}

}  // namespace

double Placement::shear() const {
  const auto& [a, b, c] = to_world.columns;
  return std::max({std::abs(dot(a, b)), std::abs(dot(b, c)), std::abs(dot(c, a))});
}

SampleFrame frame_of(const Affine& map) {
  check_directions(map);
  const auto& columns = map.columns;
  if (is_along(columns[0], 0) && is_along(columns[1], 1) && is_along(columns[2], 2))
    return {{columns[0].x, columns[1].y, columns[2].z}, map.offset, {}};
  SampleFrame frame;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    frame.spacing[axis] = norm_of_any_size(columns[axis]);
    frame.to_world.columns[axis] = columns[axis] / frame.spacing[axis];
  }
  frame.to_world.offset = map.offset;
  constexpr double kFlat = 1e-6;
  if (!(std::abs(frame.to_world.determinant()) > kFlat)) {
    throw InputError("the directions of the axes are " + text_of(columns[0]) + ", " + text_of(columns[1]) + " and " +
                     text_of(columns[2]) + ": they must not lie in a plane");
  }
  // As for the grid's own coordinates: beyond this a coordinate's rounding passes 1e-4 of a spacing.
  constexpr double kFarthest = 0x1p40;
  const double smallest = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
  if (!(norm_of_any_size(map.offset) <= kFarthest * smallest)) {
    throw InputError("the origin is " + text_of(map.offset) + " and the smallest spacing " + shortest_text(smallest) +
                     ": places must be within 1e12 spacings of 0, coordinates cannot tell them apart beyond");
  }
  return frame;
}

std::string space_name(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (lower == "lps") return std::string(kLps);
  if (lower == "ras") return std::string(kRas);
  if (lower == "las") return std::string(kLas);
  return lower;
}

Placement in_space(const Placement& placement, std::string_view space) {
  if (space == "native") return placement;
  const std::string wanted = space_name(space);
  const std::optional<Vec3> to = signs_of(wanted), from = signs_of(placement.space);
  if (!to || wanted == kLas) {
    throw InputError("--space: expected native, LPS or RAS, found '" + std::string(space) + "'");
  }
  if (!from) {
    throw InputError("--space " + std::string(space) + ": the volume " +
                     (placement.space.empty() ? "does not say its space" : "is in the space " + placement.space) +
                     ", expected LPS, RAS or LAS; use --space native");
  }
  const Vec3 signs = scaled(*from, *to);
  Placement out = placement;
  out.space = wanted;
  if (signs == Vec3{1, 1, 1}) return out;
  for (Vec3& column : out.to_world.columns) column = scaled(signs, column);
  out.to_world.offset = scaled(signs, placement.to_world.offset);
  return out;
}

}  // namespace deliso
