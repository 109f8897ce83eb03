#include "surface/recover/boundary_curves.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "surface/restricted/signed_delaunay.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

std::vector<std::unique_ptr<Scene>> scenes() {
  std::vector<std::unique_ptr<Scene>> all;
  all.push_back(field_scene("plane", 9));
  all.push_back(field_scene("gyroid", 12));
  all.push_back(testing::wave_scene({8, 9, 10}, {0.3, 1, 4}, 2));
  for (std::uint64_t seed = 0; seed < 8; ++seed) all.push_back(noise_scene({2, 4, 7}, seed));
  for (std::uint64_t seed = 8; seed < 12; ++seed) all.push_back(noise_scene({6, 6, 6}, seed));
  return all;
}

using Key = std::tuple<double, double, double>;
Key key(const Vec3& p) { return {p.x, p.y, p.z}; }

TEST(BoundaryCurves, PointsLieOnTheBoxExactlyAndOnTheSurface) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    for (const Vec3& p : boundary_curve_points(*scene->isosurface)) {
      EXPECT_TRUE(SignedDelaunay::on_box(scene->isosurface->box(), p));
      EXPECT_TRUE(scene->isosurface->box().contains(p));
      const auto [low, high] = scene->grid.range();
      EXPECT_LE(std::abs(scene->isosurface->value(p)), 1e-12 * (std::abs(low) + std::abs(high)));
    }
  }
}

TEST(BoundaryCurves, EveryCrossingOnTheBoxIsGivenOnce) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    std::set<Key> given;
    const std::vector<Vec3> points = boundary_curve_points(*scene->isosurface);
    for (const Vec3& p : points) EXPECT_TRUE(given.insert(key(p)).second) << p.x << " " << p.y << " " << p.z;
    // The crossings of all grid edges come from the exact topology.
    std::size_t crossings = 0;
    for (const EdgeCrossing& c : scene->topology.crossings) {
      const Vec3 p = scaled(crossing_position(scene->grid, c), scene->isosurface->step());
      if (!SignedDelaunay::on_box(scene->isosurface->box(), p)) continue;
      EXPECT_EQ(given.count(key(p)), 1u);
      ++crossings;
    }
    EXPECT_GT(crossings, 0u);
    // What is more lies inside faces with two arcs, at most two points in each.
    EXPECT_GE(points.size(), crossings);
  }
}

// In a face cell with four crossings the asymptotic decider says which are joined; the two points must lie one in each
// of the two corners that are cut off.
TEST(BoundaryCurves, FacesWithFourCrossingsGetAPointOnEachArc) {
  std::size_t faces = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto scene = noise_scene({2, 2, 2}, seed);
    SCOPED_TRACE(scene->name);
    const std::vector<Vec3> points = boundary_curve_points(*scene->isosurface);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double side : {0.0, 1.0}) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        const auto value = [&](double x, double y) {
          Vec3 p;
          p[axis] = side;
          p[u] = x;
          p[v] = y;
          return scene->isosurface->value(p);
        };
        if ((value(0, 0) > 0) != (value(1, 1) > 0) || (value(1, 0) > 0) != (value(0, 1) > 0) ||
            (value(0, 0) > 0) == (value(1, 0) > 0)) {
          continue;
        }
        ++faces;
        std::vector<Vec3> inside;
        for (const Vec3& p : points) {
          if (p[axis] == side && p[u] > 0 && p[u] < 1 && p[v] > 0 && p[v] < 1) inside.push_back(p);
        }
        ASSERT_EQ(inside.size(), 2u);
        // Between the two points the field takes the other sign somewhere: they are on different arcs.
        const double k = value(0, 0) - value(1, 0) - value(0, 1) + value(1, 1);
        const double cx = (value(0, 0) - value(0, 1)) / k;
        const double cy = (value(0, 0) - value(1, 0)) / k;
        EXPECT_LT((inside[0][u] - cx) * (inside[1][u] - cx), 0);
        EXPECT_LT((inside[0][v] - cy) * (inside[1][v] - cy), 0);
      }
    }
  }
  EXPECT_GT(faces, 10u);
}

TEST(BoundaryCurves, ClosedSurfacesHaveNone) {
  for (const char* name : {"sphere", "torus", "shells"}) {
    const auto scene = field_scene(name, 16);
    EXPECT_TRUE(boundary_curve_points(*scene->isosurface).empty()) << name;
  }
}

}  // namespace
}  // namespace deliso
