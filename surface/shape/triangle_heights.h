// How far the triangles of a patch lie from the isosurface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/shape/patch.h"

namespace deliso {

// A triangle may always lie this far from the isosurface (mesh-space units).
inline constexpr double kFreeDistance = 0.05;
// With these freedoms a triangle need only face lower values in one of the cells at two of its corners, or at one.
inline constexpr double kSideways = 4, kOneCorner = 8;

class TriangleHeights {
 public:
  TriangleHeights(const Patch& patch, const Isosurface& isosurface, SearchCounters& counters)
      : patch_(patch), isosurface_(isosurface), counters_(counters) {}

  // See kSideways and kOneCorner.
  void set_freedom(double freedom) { freedom_ = freedom; }
  // Of the triangles that a step removes: the sum of their normals.
  void set_old_normal(const Vec3& normal) { old_normal_ = normal; }

  // From the centroid to the isosurface where it faces as the triangle does; infinity where it is beyond `reach`.
  [[nodiscard]] double of(std::uint32_t triangle, double reach);
  // The same as far as the longest edge reaches. Faster for triangles that are asked about again and again.
  [[nodiscard]] double of_placed(std::uint32_t triangle);

 private:
  // A triangle, seen from its centroid.
  struct Facing {
    Vec3 centroid, normal;
    double length = 0;  // of the normal
  };
  [[nodiscard]] static Facing facing_of(const std::array<Vec3, 3>& corners);
  [[nodiscard]] double height_along(const Facing& facing, const Vec3& direction, double reach);
  // The hit nearest to the centroid, with its t from there, on a line in any direction.
  struct NearHit {
    Vec3 direction;
    std::optional<Hit> hit;
  };
  [[nodiscard]] NearHit near_hit(const Vec3& centroid, const Vec3& direction, double reach);
  [[nodiscard]] double sideways_height(const Facing& facing, const std::array<NearHit, 2>& own, double reach);
  [[nodiscard]] std::array<NearHit, 2> own_hits(const Facing& facing, double reach);
  [[nodiscard]] bool goes_sideways(double height, std::uint32_t triangle, const Facing& facing) const;
  [[nodiscard]] bool faces_down(std::uint32_t triangle, const Vec3& normal) const;

  const Patch& patch_;
  const Isosurface& isosurface_;
  SearchCounters& counters_;
  double freedom_ = 1;
  Vec3 old_normal_;
  // What does not depend on a step: along the triangle's own normal and down the gradient. A number may be used again,
  // so a triangle is known by where it lies.
  struct Known {
    std::array<Vec3, 3> corners;
    double along_normal = 0;
    std::optional<double> down_gradient;
    std::optional<std::array<NearHit, 2>> own_hits;
  };
  std::unordered_map<std::uint32_t, Known> known_;  // of triangles that were asked about: few of a large patch
  std::vector<Hit> hits_;
};

}  // namespace deliso
