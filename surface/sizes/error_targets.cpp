#include "surface/sizes/error_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "surface/certificate/triangle_nearness.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

// Infinite for a triangle without area.
double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  return distance(a, b) * distance(b, c) * distance(c, a) / (2 * norm(cross(b - a, c - a)));
}

}  // namespace

std::vector<Vec3> error_targets(const SurfaceMesh& mesh, const ExactSurface& surface, const GeometryCheck& check,
                                double most) {
  const Isosurface& isosurface = surface.isosurface;
  std::vector<Vec3> targets = check.missed_points;
  SearchCounters counters;
  constexpr std::int64_t kMostPlaces = 16;  // looked at of a triangle
  std::vector<Vec3> places;
  for (const std::uint32_t t : check.far_triangles) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    const std::array<Vec3, 3> corners = {mesh.points[ia], mesh.points[ib], mesh.points[ic]};
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = norm(normal), longest = std::sqrt(squared_longest_edge(mesh, t));
    if (!(length > 0)) continue;
    places.clear();
    count_far_parts(isosurface, corners, most, kMostPlaces, &places);
    double farthest = 0;
    Vec3 point;
    for (const Vec3& p : places) {
      const Line line{p, normal / length};
      const auto hit = isosurface.nearest_falling_hit(line, longest, counters);
      if (!hit || std::abs(*hit) <= farthest || !isosurface.box().contains(line.at(*hit))) continue;
      farthest = std::abs(*hit);
      point = line.at(*hit);
    }
    if (farthest > 0) targets.push_back(point);
  }
  return targets;
}

void ask_for_smaller_triangles(SurfaceMesh& mesh, const ExactSurface& surface, const GeometryCheck& check) {
  mesh.pole_heights.assign(mesh.points.size(), surface.isosurface.box().diagonal());
  const auto halve = [&](std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double half = circumradius(mesh.points[a], mesh.points[b], mesh.points[c]) / 2;
    for (const std::uint32_t v : mesh.triangles[t]) mesh.pole_heights[v] = std::min(mesh.pole_heights[v], half);
  };
  for (const std::uint32_t t : check.far_triangles) halve(t);
  if (check.missed_points.empty()) return;
  const BoxTree tree(
      mesh.triangles.size(), [&](std::size_t t) { return box_of(mesh, static_cast<std::uint32_t>(t)); },
      surface.threads);
  const double farthest = surface.isosurface.box().diagonal();
  for (const Vec3& p : check.missed_points) {
    const std::uint32_t nearest =
        tree.nearest(p, farthest * farthest,
                     [&](std::uint32_t t) {
                       const auto& [a, b, c] = mesh.triangles[t];
                       return squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]);
                     })
            .first;
    if (nearest != BoxTree::kNone) halve(nearest);
  }
}

}  // namespace deliso
