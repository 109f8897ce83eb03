#include "surface/repair/finish/marching_cubes_fallback.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/certificate/certificate.h"
#include "surface/intersection/self_intersection.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// Shells, meshed by marching cubes; some vertices of one shell are moved onto another.
TEST(MarchingCubesFallback, ReplacesPiecesUntilNothingCrosses) {
  const auto scene = testing::field_scene("shells", 48);
  const ExactSurfaceCache cache(scene->surface(1));
  const std::size_t components = scene->topology.components.size();
  ASSERT_GT(components, 1u);
  SurfaceMesh mesh = cache.polygonized().mesh;
  const std::vector<std::uint32_t>& component = cache.polygonized().component;
  ASSERT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0);

  // Some vertices of component 0 are moved onto component 1.
  Vec3 there;
  std::size_t count = 0;
  for (std::size_t v = 0; v < component.size(); ++v) {
    if (component[v] != 1) continue;
    there += mesh.points[v];
    ++count;
  }
  there = there / static_cast<double>(count);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < component.size(); ++v) {
    if (component[v] != 0 || v % 97 != 0) continue;
    mesh.points[v] = there + Vec3{1e-3 * static_cast<double>(moved), 0, 0};
    ++moved;
  }
  ASSERT_GT(moved, 0u);
  ASSERT_GT(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0);

  std::vector<bool> is_polygonized(components, false);
  Controls controls(BudgetParameters{}, nullptr, {});
  polygonize_crossing_pieces(mesh, cache, is_polygonized, controls);
  EXPECT_TRUE(is_polygonized[0] && is_polygonized[1]);
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0);
  EXPECT_EQ(mesh.pole_heights.size(), mesh.points.size());
  const TriangleMesh world = to_world(mesh, *scene->isosurface);
  EXPECT_EQ(certify(world, scene->topology).verdict, Verdict::kHomeomorphic);

  // Nothing is left to do.
  const std::vector<Vec3> before = mesh.points;
  polygonize_crossing_pieces(mesh, ExactSurfaceCache(scene->surface(2)), is_polygonized, controls);
  EXPECT_EQ(mesh.points, before);
}

}  // namespace
}  // namespace deliso
