#include "surface/coverage.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/constructions.h"
#include "surface/build_triangle_mesh.h"
#include "surface/surface_distance.h"

namespace deliso {

namespace {

constexpr double kNear = 0.8;  // mesh-space units
// How far off the surface a triangle of stage 1 is taken to be at most, in circumradii.
constexpr double kRadiusFraction = 0.3;
// Crossings are asked about brick by brick of so many samples.
constexpr std::int32_t kBrick = 8;

std::vector<Box3> boxes_of(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<Box3> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[triangles[i]]) boxes[i].extend(mesh.points[v]);
  }
  return boxes;
}

}  // namespace

MeshCover::MeshCover(const SurfaceMesh& mesh, std::vector<std::uint32_t> triangles)
    : mesh_(mesh), triangles_(std::move(triangles)), tree_(boxes_of(mesh_, triangles_)) {}

double MeshCover::squared_distance_to(const Vec3& p, std::uint32_t place) const {
  const auto& v = mesh_.triangles[triangles_[place]];
  return squared_distance_to_triangle(p, mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
}

bool MeshCover::covers(const Vec3& p, double radius_fraction) {
  if (triangles_.empty()) return false;
  for (const std::uint32_t place : recent_) {
    if (squared_distance_to(p, place) < kNear * kNear) return true;
  }
  // Most points have a triangle close by; only for the others the nearest one matters.
  const auto measure = [&](std::uint32_t place) { return squared_distance_to(p, place); };
  const auto close = tree_.nearest(p, kNear * kNear, measure);
  if (close.second < kNear * kNear) {
    recent_[turn_++ % recent_.size()] = close.first;
    return true;
  }
  const auto [place, squared] = tree_.nearest(p, std::numeric_limits<double>::infinity(), measure);
  const auto& v = mesh_.triangles[triangles_[place]];
  const double radius = circumcircle(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]).radius;
  return squared <= radius_fraction * radius_fraction * radius * radius;
}

std::vector<std::uint32_t> all_crossings(const ScalarGrid& grid, const IsosurfaceTopology& topology) {
  std::vector<std::pair<std::size_t, std::uint32_t>> order;  // (brick, crossing)
  order.reserve(topology.crossings.size());
  const auto brick = [](double x) { return static_cast<std::int32_t>(x) / kBrick; };
  for (std::uint32_t i = 0; i < topology.crossings.size(); ++i) {
    const Vec3 p = crossing_position(grid, topology.crossings[i]);
    order.emplace_back(grid.index(brick(p.x), brick(p.y), brick(p.z)), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> crossings;
  crossings.reserve(order.size());
  for (const auto& [ignored, crossing] : order) crossings.push_back(crossing);
  return crossings;
}

std::int64_t insert_uncovered(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology& topology, double min_distance,
                              std::vector<std::uint32_t>& suspects) {
  const SurfaceMesh mesh = build_triangle_mesh(restricted).mesh;
  const auto position = [&](std::uint32_t crossing) {
    return scaled(crossing_position(grid, topology.crossings[crossing]), restricted.isosurface().step());
  };
  MeshCover cover(mesh, [](std::uint32_t) { return true; });
  std::erase_if(suspects, [&](std::uint32_t i) { return cover.covers(position(i), kRadiusFraction); });
  std::int64_t inserted = 0;
  for (const std::uint32_t i : suspects) {
    const TetId start = restricted.delaunay().incident_tet(restricted.last_vertex());
    if (restricted.insert(position(i), start, min_distance) == RestrictedDelaunay::Outcome::kInserted) ++inserted;
  }
  return inserted;
}

}  // namespace deliso
