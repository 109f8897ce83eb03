#include "surface/certificate/cells/covering_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surface/mesh/side_adjacency.h"

namespace deliso {

namespace {

constexpr double kDistanceRounding = 1e-9;  // of the distance

}  // namespace

CoveringTriangles::CoveringTriangles(const SurfaceMesh& mesh, double most) : mesh_(mesh), most_(most) {
  SurfaceMesh sides;
  sides.points.resize(mesh.points.size());
  sides.triangles = mesh.triangles;
  set_side_adjacency(sides);
  is_open_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < is_open_.size(); ++t) {
    const auto& across = sides.neighbours[t];
    is_open_[t] = std::find(across.begin(), across.end(), kNoSide) == across.end() ? 0 : 1;
  }
}

bool CoveringTriangles::cover(const SurfaceHull& hull, const Vec3& falling, std::span<const std::uint32_t> near) const {
  constexpr double kLeastCosine = 0.2;  // of a triangle's normal with n: beyond that little is gained
  const double length = norm(falling);
  if (!(length > 0) || !std::isfinite(length) || hull.count() == 0) return false;
  const Vec3 n = falling / length;
  Vec3 middle;
  for (const Vec3& p : hull) middle += p;
  middle = middle / static_cast<double>(hull.count());
  bool is_over_middle = false;
  for (const std::uint32_t t : near) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const std::array<Vec3, 3> corners = {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
    const Place place = place_of(corners, hull, middle, n);
    if (place == Place::kApart) continue;
    is_over_middle = is_over_middle || place == Place::kOverMiddle;
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double facing = dot(n, normal);
    if (!(facing > kLeastCosine * norm(normal)) || is_open_[t] != 0) return false;
    const double farthest = (1 - kDistanceRounding) * most_ * facing;
    for (const Vec3& p : hull) {
      if (!(std::abs(dot(p - corners[0], normal)) <= farthest)) return false;
    }
  }
  return is_over_middle;
}

CoveringTriangles::Place CoveringTriangles::place_of(const std::array<Vec3, 3>& corners, const SurfaceHull& hull,
                                                     const Vec3& middle, const Vec3& n) const {
  bool holds_middle = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inwards = cross(n, corners[(i + 1) % 3] - corners[i]);
    const double least = -kDistanceRounding * most_ * norm(inwards);
    const auto is_outside = [&](const Vec3& p) { return dot(inwards, p - corners[i]) < least; };
    if (std::all_of(hull.begin(), hull.end(), is_outside)) return Place::kApart;
    holds_middle = holds_middle && dot(inwards, middle - corners[i]) > 0;
  }
  return holds_middle ? Place::kOverMiddle : Place::kBeside;
}

}  // namespace deliso
