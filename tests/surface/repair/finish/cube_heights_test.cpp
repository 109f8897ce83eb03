#include "surface/repair/finish/cube_heights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// The poles of a sphere are its center and points far away; those of the interpolant of one are somewhat nearer.
TEST(CubeHeights, OfASphereAreNearItsRadius) {
  const auto scene = testing::field_scene("sphere", 40);
  SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  const auto [low, high] = std::minmax_element(mesh.points.begin(), mesh.points.end(),
                                               [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
  const double radius = (high->x - low->x) / 2;
  ASSERT_GT(radius, 5);
  raise_pole_heights(mesh, 0, scene->surface());
  for (const double height : mesh.pole_heights) EXPECT_GT(height, radius / 2);
}

TEST(CubeHeights, OfNoiseAreAVoxelOrMore) {
  const auto scene = testing::noise_scene({9, 8, 9}, 2);
  SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  raise_pole_heights(mesh, 0, scene->surface());
  const auto voxels = std::count(mesh.pole_heights.begin(), mesh.pole_heights.end(), 1.0);
  EXPECT_GT(voxels, std::ssize(mesh.points) * 9 / 10);
  for (const double height : mesh.pole_heights) EXPECT_GE(height, 1);
}

TEST(CubeHeights, OfOtherComponentsStayAndPointsOnALineAreNoError) {
  const auto scene = testing::field_scene("sphere", 40);
  SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  const std::size_t first = mesh.points.size();
  for (int i = 0; i < 3; ++i) {
    mesh.points.push_back(mesh.points.front());
    mesh.pole_heights.push_back(1);
  }
  raise_pole_heights(mesh, first, scene->surface());
  for (const double height : mesh.pole_heights) EXPECT_EQ(height, 1);
}

}  // namespace
}  // namespace deliso
