// What a picture draws: where rays first hit an isosurface and a mesh, and on which side.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "delaunay/base/rng.h"
#include "experiments/pictures/camera.h"
#include "experiments/pictures/isosurface_shape.h"
#include "experiments/pictures/mesh_shape.h"
#include "raycast/isosurface.h"
#include "tests/support/sphere_pictures.h"
#include "volume/fields/field_slices.h"
#include "volume/marching_cubes/marching_cubes.h"
#include "volume/regular_isovalue.h"

namespace deliso::testing {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

TriangleMesh cubes_mesh(const ScalarGrid& grid, double isovalue) {
  MarchingCubesMesh cubes = marching_cubes(grid, isovalue);
  return {cubes.points, cubes.triangles};
}

Vec3 random_direction(Rng& rng) {
  for (;;) {
    const Vec3 v{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double length = norm(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

// A ray through a random point of the box from outside it, in a random direction.
Line random_ray(const Box3& box, Rng& rng) {
  Vec3 through;
  for (std::size_t a = 0; a < 3; ++a) through[a] = rng.uniform(box.low[a], box.high[a]);
  const Vec3 direction = random_direction(rng);
  return {through - 2 * box.diagonal() * direction, direction};
}

// Skipping bricks loses no hit: the first hit is that of one search over the whole ray.
TEST(IsosurfaceShape, FirstHitIsTheFirstOfAllHits) {
  const ScalarGrid noise = generate_field("noise", 21);
  const ScalarGrid grid({21, 21, 21}, noise.samples(), {1, 0.7, 1.9}, {-3, 2, 5});
  const double isovalue = regular_isovalue(grid, 0.5 * (grid.range().first + grid.range().second));
  const IsosurfaceShape shape(grid, isovalue);
  const Isosurface surface(grid, isovalue, SearchOptions());
  const double unit = 0.7;
  Rng rng(5);
  int found = 0;
  for (int n = 0; n < 3000; ++n) {
    Line ray = random_ray(grid.box(), rng);
    if (n % 5 == 0) ray.direction = Vec3{0, 0, 1};
    if (n % 5 == 0) ray.origin.z = -100;
    const auto part = part_in_box(ray, grid.box());
    ASSERT_EQ(part.has_value(), n % 5 != 0 || grid.box().contains({ray.origin.x, ray.origin.y, 6})) << n;
    if (!part) continue;
    std::vector<Hit> hits;
    SearchCounters counters;
    surface.all_hits({(ray.origin - grid.origin()) / unit, ray.direction / unit}, part->first, part->last, hits,
                     counters);
    const auto point = shape.first_hit(ray, -1000, 1000);
    ASSERT_EQ(point.has_value(), !hits.empty()) << n;
    if (!point) continue;
    ++found;
    EXPECT_NEAR(point->t, hits.front().t, 1e-7) << n;
    EXPECT_EQ(point->outside, !hits.front().falling) << n;
    EXPECT_NEAR(norm(point->normal), 1, 1e-12) << n;
  }
  EXPECT_GT(found, 1000);
}

TEST(MeshShape, FirstHitIsThatOfEveryTriangleTried) {
  const ScalarGrid grid = generate_field("noise", 12);
  const MeshShape shape(cubes_mesh(grid, 0.25 + std::floor(0.5 * (grid.range().first + grid.range().second))));
  const TriangleMesh& mesh = shape.mesh();
  Rng rng(6);
  int found = 0;
  for (int n = 0; n < 1500; ++n) {
    const Line ray = random_ray(shape.box(), rng);
    // The plane's point in the triangle: on the inner side of each edge.
    double first = kUnbounded;
    for (const auto& [i, j, k] : mesh.triangles) {
      const std::array<Vec3, 3> p{mesh.points[i], mesh.points[j], mesh.points[k]};
      const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
      const double t = dot(p[0] - ray.origin, normal) / dot(ray.direction, normal);
      bool inside = std::isfinite(t);
      for (std::size_t e = 0; e < 3; ++e) {
        inside = inside && dot(cross(p[(e + 1) % 3] - p[e], ray.at(t) - p[e]), normal) > 0;
      }
      if (inside) first = std::min(first, t);
    }
    const auto point = shape.first_hit(ray, 0, 1000);
    ASSERT_EQ(point.has_value(), first < kUnbounded) << n;
    if (!point) continue;
    ++found;
    EXPECT_NEAR(point->t, first, 1e-9) << n;
    EXPECT_LE(dot(point->normal, ray.direction), 0) << n;
  }
  EXPECT_GT(found, 500);
}

TEST(MeshShape, NoRayPassesBetweenTriangles) {
  // From inside a closed mesh, through vertices, middles of edges and, along axes, many of them in one plane.
  const ScalarGrid grid = sphere_grid();
  const MeshShape shape(cubes_mesh(grid, 0));
  const TriangleMesh& mesh = shape.mesh();
  const auto expect_hit = [&](const Vec3& from, const Vec3& to) {
    const double length = distance(from, to);
    const auto point = shape.first_hit({from, (to - from) / length}, 0, 100);
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->t, length, 1e-9);
    EXPECT_FALSE(point->outside);
  };
  for (const auto& triangle : mesh.triangles) {
    const Vec3& a = mesh.points[triangle[0]];
    const Vec3& b = mesh.points[triangle[1]];
    expect_hit(kCentre, a);
    expect_hit(kCentre, 0.5 * (a + b));
  }
  for (const Vec3& p : mesh.points) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
      const double inward = dot(kCentre - p, axis) > 0 ? 1 : -1;
      if (std::abs(dot(kCentre - p, axis)) < 5) continue;
      expect_hit(p + 3 * inward * axis, p);
    }
  }
}

TEST(MeshShape, IsSeenWhereTheSurfaceIs) {
  const ScalarGrid grid = sphere_grid();
  const IsosurfaceShape surface(grid, 0);
  const MeshShape mesh(cubes_mesh(grid, 0));
  View view;
  view.azimuth = 77;
  view.elevation = -33;
  view.field_of_view = 40;
  const Camera camera(view, surface.outermost_points(), 40, 40);
  int both = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const Line ray = camera.ray(x + 0.5, y + 0.5);
      const double away = norm(cross(kCentre - ray.origin, ray.direction));  // of the ray from the centre
      const auto a = surface.first_hit(ray, 0, 1000);
      const auto b = mesh.first_hit(ray, 0, 1000);
      EXPECT_FALSE(away > kRadius + 0.1 && (a || b));
      if (away > kRadius - 0.5) continue;
      ASSERT_TRUE(a && b);
      ++both;
      EXPECT_NEAR(a->t, b->t, 0.25);
      EXPECT_TRUE(a->outside && b->outside);
      EXPECT_GT(dot(a->normal, b->normal), 0.95);
      EXPECT_GT(dot(a->normal, ray.at(a->t) - kCentre), 0.98 * kRadius);
      // From behind the first hit: the far side, seen from inside.
      const auto far = mesh.first_hit(ray, b->t + 1e-6, 1000);
      ASSERT_TRUE(far);
      EXPECT_FALSE(far->outside);
    }
  }
  EXPECT_GT(both, 500);
}

}  // namespace
}  // namespace deliso::testing
