#include "surface/certificate/triangle_nearness.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/point_nearness.h"
#include "surface/certificate/triangle_side.h"

namespace deliso {

namespace {

using Part = std::array<Vec3, 3>;

class PartsOfTriangle {
 public:
  PartsOfTriangle(const Isosurface& isosurface, const Part& corners, double most, std::int64_t enough,
                  std::vector<Vec3>* places)
      : isosurface_(isosurface),
        known_(corners.begin(), corners.end()),
        normal_(cross(corners[1] - corners[0], corners[2] - corners[0])),
        most_(most),
        enough_(enough),
        places_(places) {}

  void look_at(const Part& part) {
    if (far_ >= enough_ || is_beside_known(part)) return;
    const Vec3 middle = (part[0] + part[1] + part[2]) / 3;
    const double radius = std::sqrt(std::max(
        {squared_distance(middle, part[0]), squared_distance(middle, part[1]), squared_distance(middle, part[2])}));
    const bool is_above = isosurface_.is_above(middle);
    if (radius < most_ && changes_side(isosurface_, middle, is_above, normal_, most_ - radius)) return;
    if (kSmall * radius >= most_ && (lies_between(part, middle, is_above, normal_) ||
                                     lies_between(part, middle, is_above, -isosurface_.gradient(middle)))) {
      return;
    }
    if (2 * radius <= most_) {
      if (learn_point(middle, is_above, most_ - radius)) return;
      if (kLeast * radius <= most_) return add(middle);
    }
    if (++divisions_ > kMostDivisions) return add(middle);
    divide(part);
  }

  [[nodiscard]] std::int64_t far() const { return far_; }

 private:
  static constexpr double kSmall = 8, kLeast = 8;  // parts with so small a part of the distance for radius
  static constexpr int kHalvings = 5;              // of boxes around points
  static constexpr std::size_t kMostKnown = 32;
  static constexpr int kMostDivisions = 1 << 12;

  [[nodiscard]] bool is_beside_known(const Part& part) const {
    return std::any_of(known_.begin(), known_.end(), [&](const Vec3& point) {
      return std::all_of(part.begin(), part.end(),
                         [&](const Vec3& p) { return squared_distance(p, point) <= most_ * most_; });
    });
  }

  // Adds a point of the isosurface within `reach` of p to those that are known, if there is one.
  bool learn_point(const Vec3& p, bool is_above, double reach) {
    constexpr int kBisections = 20;
    const std::optional<Vec3> across = point_across(isosurface_, p, normal_, reach, kHalvings);
    if (!across) return false;
    Vec3 here = p, there = *across;
    for (int i = 0; i < kBisections; ++i) {
      const Vec3 between = (here + there) / 2;
      (isosurface_.is_above(between) == is_above ? here : there) = between;
    }
    // The latest tell most of the parts to come.
    if (known_.size() == kMostKnown) known_.erase(known_.begin() + 3);
    known_.push_back(there);
    return true;
  }

  // Whether all of a part is on one side of the isosurface, and moved by the distance along or against a direction on
  // the other; or all of it on one when it is moved along, and on the other when it is moved against.
  [[nodiscard]] bool lies_between(const Part& part, const Vec3& middle, bool is_above, const Vec3& direction) const {
    const double length = norm_of_any_size(direction);
    if (!(length > 0) || !std::isfinite(most_ / length)) return false;
    const Vec3 offset = (most_ / length) * direction;
    const bool is_ahead_above = isosurface_.is_above(middle + offset);
    const bool is_behind_above = isosurface_.is_above(middle - offset);
    if (is_ahead_above == is_above && is_behind_above == is_above) return false;
    const auto side = [&](const Vec3& by) {
      return side_of_triangle(isosurface_, {part[0] + by, part[1] + by, part[2] + by});
    };
    // The likelier ones first.
    const std::optional<bool> across = side(is_ahead_above != is_above ? offset : -offset);
    if (!across) return false;
    if (is_ahead_above != is_behind_above && side(is_ahead_above != is_above ? -offset : offset) == is_above)
      return true;
    return side({}) == is_above;
  }

  void add(const Vec3& place) {
    ++far_;
    if (places_ != nullptr) places_->push_back(place);
  }

  void divide(const Part& part) {
    const Vec3 ab = (part[0] + part[1]) / 2, bc = (part[1] + part[2]) / 2, ca = (part[2] + part[0]) / 2;
    look_at({ab, bc, ca});
    look_at({part[0], ab, ca});
    look_at({ab, part[1], bc});
    look_at({ca, bc, part[2]});
  }

  const Isosurface& isosurface_;
  std::vector<Vec3> known_;  // points of the isosurface: the corners, and what has been found
  Vec3 normal_;
  double most_;
  std::int64_t enough_;
  std::vector<Vec3>* places_;
  std::int64_t far_ = 0;
  int divisions_ = 0;
};

// Cut into triangles with edges so much shorter that every point of them is well within the distance from a corner of
// theirs: whether the isosurface passes by each of these corners as near as is left. It does where it is as flat as the
// triangle, most of the large ones.
bool is_near_by_points(const Isosurface& isosurface, const Part& corners, double squared_longest, double most) {
  constexpr double kLeastLeft = 1.0 / 4;                         // of the distance: with less, too many fail
  const double longest = std::sqrt(squared_longest / 3) / most;  // the farthest that a point may be from the corners
  const int pieces = static_cast<int>(std::ceil(longest / (1 - kLeastLeft)));
  const double left = (1 - longest / pieces) * most;
  const Vec3 along = (corners[1] - corners[0]) / pieces, across = (corners[2] - corners[0]) / pieces;
  const Vec3 normal = cross(along, across);
  for (int i = 0; i <= pieces; ++i) {
    for (int j = 0; i + j <= pieces; ++j) {
      if ((i == 0) + (j == 0) + (i + j == pieces) > 1) continue;  // corners of the triangle lie on the isosurface
      const Vec3 p = corners[0] + i * along + j * across;
      if (!changes_side(isosurface, p, isosurface.is_above(p), normal, left)) return false;
    }
  }
  return true;
}

}  // namespace

std::int64_t count_far_parts(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double most,
                             std::int64_t enough, std::vector<Vec3>* places) {
  const double squared_longest =
      std::max({squared_distance(corners[0], corners[1]), squared_distance(corners[1], corners[2]),
                squared_distance(corners[2], corners[0])});
  // Every point of a triangle is within its longest edge over the square root of 3 of a corner.
  if (squared_longest <= 3 * most * most) return 0;
  constexpr double kFew = 12;  // parts of the distance: edges so long take 63 points at most
  if (squared_longest <= kFew * kFew * most * most && is_near_by_points(isosurface, corners, squared_longest, most)) {
    return 0;
  }
  PartsOfTriangle parts(isosurface, corners, most, enough, places);
  parts.look_at(corners);
  return parts.far();
}

TriangleReaches::TriangleReaches(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise)
    : mesh_(mesh), most_(promise.max_distance) {
  constexpr double kLeastShare = 1.0 / 40;
  const double least = kLeastShare * most_, largest = std::min(promise.max_residual, most_);
  if (least >= largest) return;
  offsets_.resize(mesh.points.size());
  for_each_block(offsets_.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      double offset = least;
      while (offset < largest && !is_shown_within(surface.isosurface, mesh.points[v], offset)) offset *= 2;
      offsets_[v] = offset == least ? 0 : std::min(offset, largest);
    }
  });
}

double TriangleReaches::operator[](std::size_t triangle) const {
  constexpr double kSmallest = 1.0 / 64;  // of the promise: what is off by all of it is told of as a vertex
  if (offsets_.empty()) return most_;
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return std::max(kSmallest * most_, most_ - std::max({offsets_[a], offsets_[b], offsets_[c]}));
}

}  // namespace deliso
