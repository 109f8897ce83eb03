// How near points of a small box are to triangles, within bounds: cheap, for many points and triangles, and enough to
// know for most points whether any triangle is within some distance. In floats, from the middle of the box.
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

  // The signed distances of four points from a plane, whose numbers stand in all places.
  struct Plane {
    Quad x{}, y{}, z{}, offset{};
    [[nodiscard]] Quad operator()(const Quad& px, const Quad& py, const Quad& pz) const {
      return (x * px + y * py) + (z * pz + offset);
    }
  };
  static Plane plane(const Vec3& normal, const Vec3& offset);

  Plane own_;
  std::array<Plane, 3> sides_;  // facing outwards
  Quad squared_stretch_{};      // how far a point beyond the sides is from the triangle, in what it is beyond them
  Quad unknown_;                // infinite when nothing is known of what the triangle is near to
};

// Of a few points, by the nearest of the triangles added.
class DistanceBounds {
 public:
  static constexpr std::size_t kMostPoints = 16;
  static constexpr double kFarthest = 16;  // of a point from the middle

  // Precondition: at least one point, and at most kMostPoints; none farther than kFarthest from `middle`.
  DistanceBounds(std::span<const Vec3> points, const Vec3& middle);

  // Precondition: planes of the same middle.
  void add(const TrianglePlanes& planes);

  // Whether some triangle certainly is within `distance` (less than 100) of a point; whether certainly none is.
  [[nodiscard]] bool is_within(std::size_t point, double distance) const {
    return most_[point / 4][point % 4] < (distance - kRounding) * (distance - kRounding);
  }
  [[nodiscard]] bool is_beyond(std::size_t point, double distance) const {
    return least_[point / 4][point % 4] > (distance + kRounding) * (distance + kRounding);
  }

 private:
  static constexpr double kRounding = 1e-3;  // by far more than what floats round off a distance

  std::size_t quads_;
  // Of each point: where it lies from the middle; and the squared distance of the nearest triangle, from both sides.
  // The last point may stand there several times.
  std::array<Quad, kMostPoints / 4> x_, y_, z_, least_, most_;
};

}  // namespace deliso
