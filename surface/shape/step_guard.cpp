#include "surface/shape/step_guard.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_set>

#include "delaunay/triangle_contact.h"
#include "surface/mesh/triangle_area.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/shape/place_search.h"
#include "surface/shape/swept_samples.h"

namespace deliso {

namespace {

// A triangle may always lie this far from the isosurface, as a fraction of its longest edge (epsilon1 of the paper is
// 0.1 of the circumradius).
constexpr double kFreeHeight = 0.1;
// Distances from triangles flatter than this are not exact; one may replace a flatter one.
constexpr double kTinySine = 1e-3;

// Whether a point is within a distance of a triangle.
bool is_within(const Vec3& p, const std::array<Vec3, 3>& corners, double reach) {
  const auto& [a, b, c] = corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] < std::min({a[axis], b[axis], c[axis]}) - reach) return false;
    if (p[axis] > std::max({a[axis], b[axis], c[axis]}) + reach) return false;
  }
  return squared_distance_to_triangle(p, a, b, c) <= reach * reach;
}

// Whether two triangles with a common edge lie on each other but for roundings, as in a wall thinner than triangles may
// be off: exactly they do not meet, but they do when they are written, and one of them faces the other sheet of the
// wall.
bool are_folded(const std::array<std::uint32_t, 3>& s, const std::array<Vec3, 3>& s_points,
                const std::array<std::uint32_t, 3>& t, const std::array<Vec3, 3>& t_points) {
  constexpr double kLeastAngle = 1e-6;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (s[(i + 1) % 3] != t[(j + 2) % 3] || s[(i + 2) % 3] != t[(j + 1) % 3]) continue;
      const Vec3 &a = s_points[(i + 1) % 3], &b = s_points[(i + 2) % 3];
      const Vec3 s_normal = cross(b - a, s_points[i] - a), t_normal = cross(a - b, t_points[j] - b);
      return dot(s_normal, t_normal) < 0 &&
             norm(cross(s_normal, t_normal)) <= kLeastAngle * norm(s_normal) * norm(t_normal);
    }
  }
  return false;
}

// The first point in each of small cubes: where vertices crowd, a few stand for all.
std::vector<Vec3> thinned(std::span<const Vec3> points) {
  constexpr double kCube = 0.1;  // mesh-space units
  using Cube = std::array<double, 3>;
  const auto hash = [](const Cube& cube) {
    std::uint64_t mixed = 0;
    for (const double x : cube)
      mixed = (mixed ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u >> 7 ^ mixed << 11;
    return static_cast<std::size_t>(mixed);
  };
  std::unordered_set<Cube, decltype(hash)> seen(points.size(), hash);
  std::vector<Vec3> kept;
  for (const Vec3& p : points) {
    // Zero has two signs: added to zero it has one.
    const Cube cube = {std::floor(p.x / kCube) + 0.0, std::floor(p.y / kCube) + 0.0, std::floor(p.z / kCube) + 0.0};
    if (seen.insert(cube).second) kept.push_back(p);
  }
  return kept;
}

std::vector<Vec3> joined(std::span<const Vec3> some, std::span<const Vec3> others) {
  std::vector<Vec3> all(some.begin(), some.end());
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace

StepGuard::StepGuard(Patch& patch, std::span<const Vec3> crossings, const Isosurface& isosurface,
                     const ShapeOptions& options, SearchCounters& counters)
    : patch_(patch),
      isosurface_(isosurface),
      max_height_(options.max_height),
      max_edge_(options.max_edge),
      max_sample_(options.max_sample),
      heights_(patch, isosurface, counters),
      vertices_(thinned(patch.points()), options.max_height),
      crossings_(joined(crossings, options.witnesses), options.max_distance) {}

bool StepGuard::apply(const PatchStep& step) {
  if (!learn_old(step.removed)) return false;
  const std::size_t first_added = patch_.triangle_count();
  const std::size_t most_turned = 8 + 4 * old_triangles_.size();
  const std::optional<double> old_volume = volume_around(step.removed.front(), most_turned);
  patch_.apply(step);
  limits_.clear();
  double longest_added = 0;
  for (std::size_t t = first_added; t < patch_.triangle_count(); ++t) {
    const double longest = longest_edge(patch_.corner_points(static_cast<std::uint32_t>(t)));
    longest_added = std::max(longest_added, longest);
    limits_.push_back(
        std::max(old_height_, std::min(max_height_, freedom_ * std::max(kFreeDistance, kFreeHeight * longest))));
  }
  if (longest_added <= std::max(max_edge_, old_longest_) && keeps_disks(step) && lies_near(first_added) &&
      (step.added.empty() || keeps_volume(old_volume, static_cast<std::uint32_t>(first_added), most_turned)) &&
      keeps_sides(first_added) && crosses_nothing(first_added) &&
      (!keeps_witnesses_ || covers_witnesses(first_added)) && samples_stay_near(first_added)) {
    return true;
  }
  patch_.undo();
  std::erase_if(far_, [&](std::uint32_t t) { return t >= first_added; });
  return false;
}

// What there is before the step: links, points of the mesh and of the isosurface, normal, heights. False when a vertex
// is no disk.
bool StepGuard::learn_old(std::span<const std::uint32_t> removed) {
  changed_.clear();
  for (const std::uint32_t t : removed) {
    changed_.insert(changed_.end(), patch_.corners(t).begin(), patch_.corners(t).end());
  }
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  was_closed_.clear();
  for (const std::uint32_t v : changed_) {
    if (!patch_.is_whole(v) || !patch_.find_link(v, link_)) return false;
    was_closed_.push_back(link_.is_closed ? 1 : 0);
  }
  Vec3 old_normal;
  old_longest_ = 0;
  old_triangles_.clear();
  for (const std::uint32_t t : removed) {
    const auto [a, b, c] = old_triangles_.emplace_back(patch_.corner_points(t));
    old_normal += cross(b - a, c - a);
    old_longest_ = std::max(old_longest_, longest_edge({a, b, c}));
  }
  heights_.set_old_normal(old_normal);
  old_height_ = 0;
  old_unfaced_ = {};
  for (const std::uint32_t t : removed) {
    const double height = heights_.of_placed(t);
    if (std::isfinite(height)) {
      old_height_ = std::max(old_height_, height);
    } else {
      old_unfaced_.add(patch_.corner_points(t));
    }
  }
  return true;
}

// The links of all vertices around are what they were, cycles or paths; one vertex may be gone. Edges of the boundary
// lie in a face of the box.
bool StepGuard::keeps_disks(const PatchStep& step) {
  const Box3& box = isosurface_.box();
  const auto is_right = [&](std::uint32_t v, bool is_closed) {
    if (!patch_.find_link(v, link_) || link_.is_closed != is_closed) return false;
    if (is_closed) return true;
    const unsigned faces = faces_at(box, patch_.point(v));
    return (faces & faces_at(box, patch_.point(link_.vertices.front()))) != 0 &&
           (faces & faces_at(box, patch_.point(link_.vertices.back()))) != 0;
  };
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const std::uint32_t v = changed_[i];
    if (!patch_.star(v).empty() && !is_right(v, was_closed_[i] != 0 && v != step.opened)) return false;
  }
  const bool is_new = step.vertex != kNoVertex && !std::binary_search(changed_.begin(), changed_.end(), step.vertex);
  return !is_new || is_right(step.vertex, !step.is_on_boundary);
}

// Whether the mesh is still near all witnesses: else steps could cut off the tip of a thin part, one after the other.
bool StepGuard::covers_witnesses(std::size_t first_added) {
  Box3 box;
  double longest = 0;
  for (const std::array<Vec3, 3>& corners : old_triangles_) {
    for (const Vec3& p : corners) box.extend(p);
    longest = std::max(longest, longest_edge(corners));
  }
  vertices_.reach = std::min(max_height_, freedom_ * std::max(kFreeDistance, kFreeHeight * longest));
  for (const Witnesses* const witnesses : {&vertices_, &crossings_}) {
    const double reach = witnesses->reach;
    const Vec3 margin{reach, reach, reach};
    bool are_covered = true;
    witnesses->grid.for_each_near({box.low - margin, box.high + margin}, [&](std::uint32_t i) {
      const Vec3& p = witnesses->points[i];
      are_covered = are_covered && (!was_covered(p, reach) || is_covered(p, reach, first_added));
    });
    if (!are_covered) return false;
  }
  return true;
}

bool StepGuard::was_covered(const Vec3& p, double reach) const {
  return std::any_of(old_triangles_.begin(), old_triangles_.end(),
                     [&](const std::array<Vec3, 3>& corners) { return is_within(p, corners, reach); });
}

bool StepGuard::is_covered(const Vec3& p, double reach, std::size_t first_added) {
  for (std::size_t t = first_added; t < patch_.triangle_count(); ++t) {
    if (is_within(p, patch_.corner_points(static_cast<std::uint32_t>(t)), reach)) return true;
  }
  const Vec3 margin{reach, reach, reach};
  near_.clear();
  patch_.append_near({p - margin, p + margin}, near_);
  return std::any_of(near_.begin(), near_.end(),
                     [&](std::uint32_t t) { return is_within(p, patch_.corner_points(t), reach); });
}

bool StepGuard::keeps_sides(std::size_t first_added) {
  new_triangles_.clear();
  for (std::size_t t = first_added; t < patch_.triangle_count(); ++t) {
    new_triangles_.push_back(patch_.corner_points(static_cast<std::uint32_t>(t)));
  }
  return !sweeps_lone_sample(old_triangles_, new_triangles_, isosurface_);
}

std::optional<double> StepGuard::volume_around(std::uint32_t triangle, std::size_t most) {
  if (component_.exceeds(patch_, triangle, most)) return std::nullopt;
  near_.assign(1, triangle);
  const Vec3 apex = patch_.corner_points(triangle)[0];
  double volume = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const auto [a, b, c] = patch_.corner_points(near_[i]);
    volume += dot(a - apex, cross(b - apex, c - apex)) / 6;
    const std::array<std::uint32_t, 3>& corners = patch_.corners(near_[i]);
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t beyond = patch_.across(near_[i], corners[(side + 1) % 3], corners[(side + 2) % 3]);
      if (beyond == kNoVertex) return std::nullopt;
      if (std::find(near_.begin(), near_.end(), beyond) == near_.end()) near_.push_back(beyond);
    }
    if (near_.size() > most) return std::nullopt;
  }
  return volume;
}

bool StepGuard::keeps_volume(const std::optional<double>& old_volume, std::uint32_t triangle, std::size_t most) {
  constexpr double kLeastShare = 0.5, kFlat = 1e-9;  // mesh-space units
  if (!old_volume) return true;
  const std::optional<double> volume = volume_around(triangle, most);
  if (!volume) return false;
  // Of one as thin as rounding no sign tells which way it faces: it stays so thin.
  if (std::abs(*old_volume) < kFlat) return std::abs(*volume) < kFlat;
  return *volume / *old_volume >= kLeastShare;
}

void StepGuard::append_meeting(std::uint32_t triangle, std::vector<std::uint32_t>& found) {
  near_.clear();
  patch_.append_near(patch_.box_of(triangle), near_);
  for (const std::uint32_t u : near_) {
    const std::array<Vec3, 3> points = patch_.corner_points(triangle), other_points = patch_.corner_points(u);
    if (u == triangle || is_without_area(other_points)) continue;
    const std::array<std::uint32_t, 3>&corners = patch_.corners(triangle), &others = patch_.corners(u);
    if (triangle_contact(corners, points, others, other_points) != TriangleContact::kNone ||
        are_folded(corners, points, others, other_points)) {
      found.push_back(u);
    }
  }
}

bool StepGuard::crosses_nothing(std::size_t first_added) {
  double least_old = 1;
  for (const auto& [a, b, c] : old_triangles_) least_old = std::min(least_old, sine_of_least_angle(a, b, c));
  for (std::size_t i = first_added; i < patch_.triangle_count(); ++i) {
    const auto t = static_cast<std::uint32_t>(i);
    if (!(patch_.quality(t) > std::min(kTinySine, least_old))) return false;
    if (may_meet_) continue;
    meeting_.clear();
    append_meeting(t, meeting_);
    if (!meeting_.empty()) return false;
  }
  return true;
}

}  // namespace deliso
