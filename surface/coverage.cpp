#include "surface/coverage.h"

#include <cmath>
#include <limits>

#include "delaunay/base/box3.h"
#include "delaunay/constructions.h"
#include "surface/box_tree.h"
#include "surface/build_triangle_mesh.h"
#include "surface/surface_distance.h"

namespace deliso {

namespace {

constexpr double kNear = 0.8;  // mesh-space units
constexpr double kRadiusFraction = 0.3;

}  // namespace

std::vector<std::uint32_t> uncovered_crossings(const SurfaceMesh& mesh, const ScalarGrid& grid, const Vec3& step,
                                               const IsosurfaceTopology& topology, const std::vector<bool>& wanted) {
  std::vector<std::uint32_t> uncovered;
  if (mesh.triangles.empty()) return uncovered;
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) boxes[t].extend(mesh.points[v]);
  }
  const BoxTree tree(boxes);
  const auto corner = [&](std::uint32_t t, unsigned i) -> const Vec3& { return mesh.points[mesh.triangles[t][i]]; };
  for (std::uint32_t i = 0; i < topology.crossings.size(); ++i) {
    if (!wanted[topology.crossings[i].component]) continue;
    const Vec3 p = scaled(crossing_position(grid, topology.crossings[i]), step);
    const auto measure = [&](std::uint32_t t) {
      return squared_distance_to_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
    };
    // Most crossings have a triangle close by; only for the others the nearest one matters.
    if (tree.nearest(p, kNear * kNear, measure).second < kNear * kNear) continue;
    const auto [t, squared] = tree.nearest(p, std::numeric_limits<double>::infinity(), measure);
    const double radius = circumcircle(corner(t, 0), corner(t, 1), corner(t, 2)).radius;
    if (std::sqrt(squared) > kRadiusFraction * radius) uncovered.push_back(i);
  }
  return uncovered;
}

std::int64_t insert_uncovered(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology& topology, double min_distance) {
  const Vec3& step = restricted.isosurface().step();
  const SurfaceMesh mesh = build_triangle_mesh(restricted).mesh;
  const std::vector<bool> all(topology.components.size(), true);
  std::int64_t inserted = 0;
  for (const std::uint32_t i : uncovered_crossings(mesh, grid, step, topology, all)) {
    const Vec3 p = scaled(crossing_position(grid, topology.crossings[i]), step);
    const TetId start = restricted.delaunay().incident_tet(restricted.last_vertex());
    if (restricted.insert(p, start, min_distance) == RestrictedDelaunay::Outcome::kInserted) ++inserted;
  }
  return inserted;
}

}  // namespace deliso
