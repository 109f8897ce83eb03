#include "surface/sizes/error_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/triangle_nearness.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

constexpr std::size_t kTrianglesAtOnce = 64;

// Infinite for a triangle without area.
double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  return distance(a, b) * distance(b, c) * distance(c, a) / (2 * norm(cross(b - a, c - a)));
}

// Of the places of a triangle that are too far, and not too many: the point of the isosurface farthest above or below
// one.
std::optional<Vec3> farthest_above(const SurfaceMesh& mesh, std::uint32_t t, const Isosurface& isosurface,
                                   double most) {
  constexpr std::int64_t kMostPlaces = 16;
  const auto& [ia, ib, ic] = mesh.triangles[t];
  const std::array<Vec3, 3> corners = {mesh.points[ia], mesh.points[ib], mesh.points[ic]};
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = norm(normal), longest = std::sqrt(squared_longest_edge(mesh, t));
  if (!(length > 0)) return std::nullopt;
  std::vector<Vec3> places;
  count_far_parts(isosurface, corners, most, kMostPlaces, &places);
  SearchCounters counters;
  double farthest = 0;
  std::optional<Vec3> point;
  for (const Vec3& p : places) {
    const Line line{p, normal / length};
    const auto hit = isosurface.nearest_falling_hit(line, longest, counters);
    if (!hit || std::abs(*hit) <= farthest || !isosurface.box().contains(line.at(*hit))) continue;
    farthest = std::abs(*hit);
    point = line.at(*hit);
  }
  return point;
}

}  // namespace

std::vector<Vec3> error_targets(const SurfaceMesh& mesh, const ExactSurface& surface, const GeometryCheck& check,
                                double most) {
  std::vector<Vec3> targets = check.missed_points;
  const std::vector<Vec3> above = collect_in_blocks<Vec3>(
      check.far_triangles.size(), surface.threads,
      [&](std::size_t i, std::vector<Vec3>& found) {
        if (surface.is_over()) return;
        const auto target = farthest_above(mesh, check.far_triangles[i], surface.isosurface, most);
        if (target) found.push_back(*target);
      },
      kTrianglesAtOnce);
  targets.insert(targets.end(), above.begin(), above.end());
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
