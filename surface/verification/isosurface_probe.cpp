#include "surface/verification/isosurface_probe.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "delaunay/base/check.h"
#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

constexpr double kReach = 2.0;       // voxels; the longest walk along a line
constexpr double kFirstStep = 0.25;  // voxels; the longest first step of a walk
// Voxels; beyond this distance all directions are tried, and the grid-edge crossings.
constexpr double kFar = 0.25;
constexpr double kMoved = 1e-4;   // the same limit near a grid face or edge
constexpr double kBeside = 1e-3;  // grid steps; nearer than this counts as near a grid face or edge
// A first foot point farther than this times the estimate from value and slope is doubted.
constexpr double kSurprising = 1.5;
constexpr int kRefinements = 4;     // number of walks along the gradient at the foot point found last
constexpr double kNearer = 0.6;     // a search looks only for points nearer than this times the present distance
constexpr double kSmallest = 1e-9;  // voxels; if the present distance is below this, nothing nearer is searched for

// Corner i: bit a of i says whether it lies at the high end of axis a.
Vec3 corner_of(const Box3& box, unsigned i) {
  return {((i & 1u) != 0 ? box.high : box.low).x, ((i & 2u) != 0 ? box.high : box.low).y,
          ((i & 4u) != 0 ? box.high : box.low).z};
}

}  // namespace

IsosurfaceProbe::IsosurfaceProbe(const ScalarGrid& grid, double isovalue, std::span<const EdgeCrossing> crossings)
    : grid_(grid),
      isovalue_(isovalue),
      crossings_(crossings),
      voxel_(std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z})),
      step_(grid.spacing() / voxel_) {
  DELISO_CHECK(!crossings.empty(), "an isosurface crosses some grid edge");
  const auto& dims = grid.dims();
  box_ = {{0, 0, 0}, scaled(step_, {double(dims[0] - 1), double(dims[1] - 1), double(dims[2] - 1)})};
}

IsosurfaceProbe::Place IsosurfaceProbe::place(const Vec3& p) const {
  std::array<std::int32_t, 3> cell{};
  Place result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t last = grid_.dims()[axis] - 2;
    // In this order NaN counts as 0: differences of huge samples may have overflowed on the way here.
    const double x = std::min(std::max(0.0, p[axis] / step_[axis]), static_cast<double>(last + 1));
    cell[axis] = std::min(static_cast<std::int32_t>(x), last);
    result.uvw[axis] = x - cell[axis];
  }
  // The isovalue is taken off here: samples a few units in the last place apart give no interpolant to take it off.
  result.corners = grid_.cell(cell[0], cell[1], cell[2]);
  for (double& corner : result.corners) corner -= isovalue_;
  return result;
}

double IsosurfaceProbe::value(const Vec3& p) const {
  const Place at = place(p);
  return trilinear_value(at.corners, at.uvw);
}

Vec3 IsosurfaceProbe::gradient(const Vec3& p) const {
  const Place at = place(p);
  const Vec3 g = trilinear_gradient(at.corners, at.uvw);
  return {g.x / step_.x, g.y / step_.y, g.z / step_.z};
}

// Walks from p by growing steps until the value changes sign, then closes in by false position (Illinois rule). The
// foot is clamped to the box: beyond it the value is that of the clamped point.
std::optional<FootPoint> IsosurfaceProbe::along_line(const Vec3& p, double value_at_p, const Vec3& direction,
                                                     double first_step, double reach) const {
  const auto foot = [&](double t) {
    const Vec3 x = box_.clamp(p + t * direction);
    return FootPoint{x, deliso::distance(p, x)};
  };
  double t0 = 0, f0 = value_at_p;
  double t1 = std::min(std::max(1e-14, first_step), reach), f1 = value(p + t1 * direction);
  while ((f1 < 0) == (f0 < 0) && f1 != 0) {
    if (t1 >= reach) return std::nullopt;
    t0 = t1;
    f0 = f1;
    t1 = std::min(2 * t1, reach);
    f1 = value(p + t1 * direction);
  }
  // The root lies between t0 and t1, the latest guess. The value at an end that stays twice is halved from then on.
  for (int i = 0; i < 60 && f1 != 0; ++i) {
    double t = t1 - f1 * (t1 - t0) / (f1 - f0);
    if (!(std::min(t0, t1) < t && t < std::max(t0, t1))) t = 0.5 * (t0 + t1);
    const double f = value(p + t * direction), moved = std::abs(t - t1);
    if ((f < 0) == (f1 < 0)) {
      f0 *= 0.5;
    } else {
      t0 = t1;
      f0 = f1;
    }
    t1 = t;
    f1 = f;
    if (moved < 1e-13) break;
  }
  return foot(t1);
}

void IsosurfaceProbe::look_among_crossings(const Vec3& p, FootPoint& best) {
  if (!tree_) {
    points_ = crossing_points();
    std::vector<Box3> boxes;
    boxes.reserve(points_.size());
    for (const Vec3& point : points_) boxes.push_back({point, point});
    tree_.emplace(boxes);
  }
  const auto [nearest, squared] = tree_->nearest(p, best.distance * best.distance,
                                                 [&](std::uint32_t i) { return squared_distance(p, points_[i]); });
  if (nearest != BoxTree::kNone) best = {points_[nearest], std::sqrt(squared)};
}

// The axes across which a grid face is near p, as bits.
unsigned IsosurfaceProbe::faces_beside(const Vec3& p) const {
  unsigned faces = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double place = p[axis] / step_[axis];
    if (std::abs(place - std::round(place)) < kBeside) faces |= 1u << axis;
  }
  return faces;
}

// The cells at a grid face have the same gradient except for its component across the face. So walks go straight across
// the face from p, and along lines within the face from its point nearest to p.
void IsosurfaceProbe::look_around_grid_face(const Vec3& p, unsigned axis, FootPoint& best) const {
  for (const double side : {1.0, -1.0}) {
    Vec3 across;
    across[axis] = side;
    const auto found = along_line(p, value(p), across, kBeside * kFirstStep, std::min(kReach, best.distance));
    if (found && found->distance < best.distance) best = *found;
  }
  Vec3 q = p;
  q[axis] = step_[axis] * std::round(p[axis] / step_[axis]);
  const double f = value(q);
  for (int i = 0; i < 25; ++i) {
    const int u = i % 5 - 2, v = i / 5 - 2;
    if (std::max(std::abs(u), std::abs(v)) != 2) continue;
    Vec3 direction;
    direction[(axis + 1) % 3] = u;
    direction[(axis + 2) % 3] = v;
    const auto found =
        along_line(q, f, direction / norm(direction), kBeside * kFirstStep, std::min(kReach, best.distance));
    if (!found) continue;
    const double distance = deliso::distance(p, found->point);
    if (distance < best.distance) best = {found->point, distance};
  }
}

// For a point moved slightly off the surface (by about kMoved) near a grid edge or the saddle of a face. If sharp
// creases of the surface meet there, hardly any line through the point leads back to the surface.
void IsosurfaceProbe::look_beside_creases(const Vec3& p, FootPoint& best) {
  const unsigned faces = faces_beside(p);
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((faces >> axis & 1u) != 0) look_around_grid_face(p, axis, best);
  }
  if (std::popcount(faces) >= 2) look_among_crossings(p, best);
}

FootPoint IsosurfaceProbe::foot_along_gradients(const Vec3& p) {
  FootPoint best{p, std::numeric_limits<double>::infinity()};
  const double f = value(p);
  if (f == 0) {
    best.point = box_.clamp(p);
    best.distance = deliso::distance(p, best.point);
    return best;
  }
  // Tries a direction and keeps its foot point if that is nearer. Returns whether it is nearer by enough for another
  // walk.
  const auto try_direction = [&](const Vec3& direction, double guess) {
    const double length = norm_of_any_size(direction);
    if (!(length > 0) || !std::isfinite(length)) return false;
    const std::optional<FootPoint> found =
        along_line(p, f, direction / length, 1.0625 * std::min(guess, kFirstStep), std::min(kReach, best.distance));
    const bool is_progress = found && found->distance < 0.999 * best.distance;
    if (found && found->distance < best.distance) best = *found;
    return is_progress;
  };

  // First down or up the gradient at p. On a crease the gradient of one cell may lead into another cell, where it is
  // not valid. Then many directions are tried: along those in a grid face or edge all its cells have the same values.
  const double uphill = f > 0 ? -1 : 1;
  const Vec3 normal = gradient(p);
  const double promised = std::abs(f) / norm_of_any_size(normal);
  try_direction(uphill * normal, promised);
  if (!(best.distance <= std::min(kSurprising * promised, kFar))) {
    for (int i = 0; i < 125; ++i) {
      const int x = i % 5 - 2, y = i / 5 % 5 - 2, z = i / 25 - 2;
      const Vec3 direction{double(x), double(y), double(z)};
      const bool is_on_shell = std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2;
      if (is_on_shell) try_direction(direction, std::min(promised, best.distance / 3));
    }
  }
  if (best.distance > kMoved) look_beside_creases(p, best);
  if (best.distance > kFar) look_among_crossings(p, best);
  // Then along the gradient at the foot, which is the surface's normal there.
  for (int i = 0; i < kRefinements; ++i) {
    if (!try_direction(uphill * gradient(best.point), best.distance)) break;
  }
  return best;
}

// Looks for points nearer than `beyond` that lie on the other side of the isosurface than p. The interpolant is linear
// along each axis, so within a box its extremes are at the corners. If all corners are on p's side, so is the whole
// box. Precondition: `box` lies within a cell.
void IsosurfaceProbe::look_in_box(const Vec3& p, bool is_below, const Box3& box, FootPoint& beyond) const {
  const auto is_too_far = [&](const Box3& part) {
    const double gap = deliso::distance(p, part.clamp(p));
    return beyond.distance < kSmallest || gap >= kNearer * beyond.distance;
  };
  if (is_too_far(box)) return;
  bool has_beyond = false;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 x = corner_of(box, corner);
    if ((value(x) < 0) == is_below) continue;
    has_beyond = true;
    const double distance = deliso::distance(p, x);
    if (distance < beyond.distance) beyond = {x, distance};
  }
  if (!has_beyond) return;

  // The eight octants, from the one that holds or is nearest to p to the opposite one.
  const Vec3 middle = 0.5 * (box.low + box.high);
  unsigned next = 0;
  for (unsigned axis = 0; axis < 3; ++axis) next |= p[axis] < middle[axis] ? 0u : 1u << axis;
  for (const unsigned away : {0u, 1u, 2u, 4u, 3u, 5u, 6u, 7u}) {
    Box3 part{middle, middle};
    part.extend(corner_of(box, next ^ away));
    look_in_box(p, is_below, part, beyond);
  }
}

FootPoint IsosurfaceProbe::foot_point(const Vec3& p, double most) {
  const FootPoint best = foot_along_gradients(p);
  if (best.distance <= most || !(most > 0)) return best;
  return foot_within(p, most).value_or(best);
}

FootPoint IsosurfaceProbe::nearest_point(const Vec3& p, double most) {
  FootPoint best = foot_point(p, most);
  if (best.distance <= kMoved) return best;
  const double f = value(p), reach = std::min(best.distance, kFar);
  const Vec3 low = box_.clamp(p - Vec3{reach, reach, reach}), high = box_.clamp(p + Vec3{reach, reach, reach});
  // Split the box at grid faces: there is at most one across each axis.
  Vec3 cut;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cut[axis] = std::clamp(step_[axis] * std::round(p[axis] / step_[axis]), low[axis], high[axis]);
  }
  FootPoint beyond{p, reach};
  for (unsigned corner = 0; corner < 8; ++corner) {
    Box3 part{cut, cut};
    part.extend(corner_of({low, high}, corner));
    if (part.smallest_side() > 0) look_in_box(p, f < 0, part, beyond);
  }
  if (beyond.point == p) return best;
  // On the way to this point the isosurface is crossed, at the latest within rounding of it.
  const Vec3 direction = (beyond.point - p) / beyond.distance;
  return along_line(p, f, direction, beyond.distance, beyond.distance).value_or(beyond);
}

std::vector<Vec3> IsosurfaceProbe::crossing_points() const {
  std::vector<Vec3> points;
  points.reserve(crossings_.size());
  for (const EdgeCrossing& crossing : crossings_) {
    points.push_back(scaled(step_, crossing_position(grid_, crossing)));
  }
  return points;
}

}  // namespace deliso
