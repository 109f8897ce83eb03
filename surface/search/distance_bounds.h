// Bounds of the distances from points of a small box to triangles. They are cheap for many points and triangles, and
// decide for most points whether any triangle is within some distance. Computed in floats, relative to the middle of
// the box.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "delaunay/base/vec3.h"

namespace deliso {

// Four numbers in one register, as every 64-bit processor has it (vector extensions of gcc and clang).
using Quad = float __attribute__((vector_size(16)));

// A triangle's plane and the three that stand on its sides.
class TrianglePlanes {
 public:
  TrianglePlanes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& middle);

 private:
  friend class DistanceBounds;

  // The signed distances of four points from a plane; each coefficient of the plane is repeated in all four lanes.
  struct Plane {
    Quad x{}, y{}, z{}, offset{};
    [[nodiscard]] Quad operator()(const Quad& px, const Quad& py, const Quad& pz) const {
      return (x * px + y * py) + (z * pz + offset);
    }
  };
  static Plane plane(const Vec3& normal, const Vec3& offset);

  Plane own_;
  std::array<Plane, 3> sides_;  // facing outwards
  Quad squared_stretch_{};      // bounds the distance from the triangle by the distance beyond the sides
  Quad unknown_;                // infinite when nothing can be said about distances to the triangle
};

// For a few points: bounds of the distance to the nearest of the triangles added.
class DistanceBounds {
 public:
  static constexpr std::size_t kMostPoints = 16;
  static constexpr double kFarthest = 16;  // largest distance of a point from the middle

  // Precondition: at least one point, and at most kMostPoints; none farther than kFarthest from `middle`.
  DistanceBounds(std::span<const Vec3> points, const Vec3& middle);

  // Precondition: the planes were made with the same middle.
  void add(const TrianglePlanes& planes);

  // Whether some triangle is certainly within `distance` (below 100) of a point; whether certainly none is.
  [[nodiscard]] bool is_within(std::size_t point, double distance) const {
    return most_[point / 4][point % 4] < (distance - kRounding) * (distance - kRounding);
  }
  [[nodiscard]] bool is_beyond(std::size_t point, double distance) const {
    return least_[point / 4][point % 4] > (distance + kRounding) * (distance + kRounding);
  }

 private:
  static constexpr double kRounding = 1e-3;  // far more than the rounding error of a distance in floats

  std::size_t quads_;
  // For each point: its position relative to the middle, and a lower and an upper bound of the squared distance of the
  // nearest triangle. The last point may be stored several times.
  std::array<Quad, kMostPoints / 4> x_, y_, z_, least_, most_;
};

}  // namespace deliso
