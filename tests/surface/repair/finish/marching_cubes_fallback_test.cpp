#include "surface/repair/finish/marching_cubes_fallback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

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
  polygonize_crossing_pieces(mesh, cache, {}, is_polygonized, controls);
  EXPECT_TRUE(is_polygonized[0] && is_polygonized[1]);
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0);
  EXPECT_EQ(mesh.pole_heights.size(), mesh.points.size());
  const TriangleMesh world = to_world(mesh, *scene->isosurface);
  EXPECT_EQ(certify(world, scene->topology).verdict, Verdict::kHomeomorphic);

  // Nothing is left to do.
  const std::vector<Vec3> before = mesh.points;
  polygonize_crossing_pieces(mesh, ExactSurfaceCache(scene->surface(2)), {}, is_polygonized, controls);
  EXPECT_EQ(mesh.points, before);
}

// The poles of a sphere are its center and points far away; those of the interpolant of one are somewhat nearer.
TEST(MarchingCubesFallback, PoleHeightsOfASphereAreNearItsRadius) {
  const auto scene = testing::field_scene("sphere", 40);
  SurfaceMesh mesh;
  append_cubes(ExactSurfaceCache(scene->surface()), {true}, {}, mesh);
  const auto [low, high] = std::minmax_element(mesh.points.begin(), mesh.points.end(),
                                               [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
  const double radius = (high->x - low->x) / 2;
  ASSERT_GT(radius, 5);
  for (const double height : mesh.pole_heights) EXPECT_GT(height, radius / 2);
}

TEST(MarchingCubesFallback, PoleHeightsOfNoiseAreAVoxelOrMore) {
  const auto scene = testing::noise_scene({9, 8, 9}, 2);
  SurfaceMesh mesh;
  append_cubes(ExactSurfaceCache(scene->surface()), std::vector<bool>(scene->topology.components.size(), true), {},
               mesh);
  const auto voxels = std::count(mesh.pole_heights.begin(), mesh.pole_heights.end(), 1.0);
  EXPECT_GT(voxels, std::ssize(mesh.points) * 9 / 10);
  for (const double height : mesh.pole_heights) EXPECT_GE(height, 1);
}

TEST(MarchingCubesFallback, PoleHeightsOfOtherComponentsStay) {
  const auto scene = testing::field_scene("shells", 48);
  const ExactSurfaceCache cache(scene->surface());
  std::vector<bool> others(scene->topology.components.size(), true);
  others[0] = false;
  SurfaceMesh mesh;
  append_pieces(cache.polygonized().mesh, cache.polygonized().component, {true}, mesh);
  const std::size_t first = mesh.points.size();
  append_cubes(cache, others, {}, mesh);
  for (std::size_t v = 0; v < first; ++v) EXPECT_EQ(mesh.pole_heights[v], 1);
  EXPECT_GT(*std::max_element(mesh.pole_heights.begin(), mesh.pole_heights.end()), 1);
}

// All crossings round to the same sample: there is no triangulation of their points.
TEST(MarchingCubesFallback, PointsOnALineAreNoError) {
  std::vector<double> samples(5 * 5 * 5, 0);
  samples[2 + 5 * (2 + 5 * 2)] = 1;
  const testing::Scene scene("sample", {{5, 5, 5}, std::move(samples)}, 1 - 0x1p-53);
  SurfaceMesh mesh;
  append_cubes(ExactSurfaceCache(scene.surface()), {true}, {}, mesh);
  EXPECT_EQ(mesh.points.size(), 6u);
  for (const double height : mesh.pole_heights) EXPECT_EQ(height, 1);
}

}  // namespace
}  // namespace deliso
