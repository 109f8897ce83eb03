#include "surface/verification/delaunay_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "delaunay/constructions.h"
#include "raycast/isosurface.h"
#include "surface/search/box_tree.h"

namespace deliso {

DelaunayBallCheck check_delaunay_balls(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue) {
  constexpr double kInside = 1 - 1e-9;  // of the radius
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Isosurface isosurface(grid, isovalue, SearchOptions{});
  std::vector<Box3> boxes;
  boxes.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) boxes.push_back({p, p});
  const BoxTree tree(boxes);

  DelaunayBallCheck check;
  SearchCounters counters;
  for (const auto& triangle : mesh.triangles) {
    // The ball: its centre on the dual line, its radius that of the nearest corner.
    const Vec3 &a = mesh.points[triangle[0]], &b = mesh.points[triangle[1]], &c = mesh.points[triangle[2]];
    const Circumcircle circle = circumcircle(a, b, c);
    const Vec3 normal = cross(b - a, c - a);
    const double length = norm(normal);
    std::optional<double> t;
    if (length > 0 && std::isfinite(circle.radius) && is_finite(circle.center)) {
      t = isosurface.nearest_falling_hit({circle.center, normal / length}, isosurface.box().diagonal(), counters);
    }
    if (!t) {
      ++check.without_hit;
      continue;
    }
    const Vec3 center = circle.center + *t / length * normal;
    const double squared_radius =
        std::min({squared_distance(center, a), squared_distance(center, b), squared_distance(center, c)});

    // Finds another vertex inside the ball. Vertices with the coordinates of a corner lie on the ball.
    const auto measure = [&](std::uint32_t v) {
      const bool is_corner = std::find(triangle.begin(), triangle.end(), v) != triangle.end();
      return is_corner ? kInfinity : squared_distance(center, mesh.points[v]);
    };
    const auto [inside, squared] = tree.nearest(center, kInside * kInside * squared_radius, measure);
    check.occupied += inside == BoxTree::kNone ? 0 : 1;
  }
  check.pass = check.occupied == 0 && check.without_hit == 0;
  return check;
}

}  // namespace deliso
