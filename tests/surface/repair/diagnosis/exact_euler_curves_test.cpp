// The exact Euler curves, computed cell by cell, must equal those of the marching-cubes mesh as a whole.
#include "surface/repair/diagnosis/exact_euler_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;

// In index space; coordinates rounded off a sample layer are moved back onto it.
void to_index_space(SurfaceMesh& mesh, const Vec3& step) {
  for (Vec3& p : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = p[axis] / step[axis];
      p[axis] = std::abs(at - std::round(at)) < 1e-9 ? std::round(at) : at;
    }
  }
}

void expect_characteristics(const testing::Scene& scene) {
  const ExactEulerCurves curves(scene.surface());
  for (std::uint32_t c = 0; c < scene.topology.components.size(); ++c) {
    for (const auto& along : curves.of(c)) {
      EXPECT_EQ(along.back(), scene.topology.components[c].euler_characteristic) << c;
    }
  }
}

void expect_those_of_the_mesh(const testing::Scene& scene) {
  ExactPolygonization surface = exact_polygonization(scene.surface());
  to_index_space(surface.mesh, scene.isosurface->step());
  const std::size_t components = scene.topology.components.size();
  const auto expected = euler_curves(surface.mesh, surface.component, components, {1, 1, 1}, scene.grid.dims());
  const ExactEulerCurves curves(scene.surface());
  for (std::uint32_t c = 0; c < components; ++c) EXPECT_EQ(curves.of(c), expected[c]) << c;
  expect_characteristics(scene);
}

// Cut by the box in many arcs, with tunnels and disks that need inner points.
TEST(ExactEulerCurves, AreThoseOfTheMarchingCubesMeshOfNoise) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const auto scene = noise_scene({14, 13, 12}, seed);
    ASSERT_GT(scene->topology.components.size(), 5u);
    expect_those_of_the_mesh(*scene);
  }
}

TEST(ExactEulerCurves, AreThoseOfTheMarchingCubesMeshOfThinVolumes) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    expect_those_of_the_mesh(*noise_scene({2, 9, 7}, seed));
    expect_those_of_the_mesh(*noise_scene({6, 2, 2}, seed));
  }
}

TEST(ExactEulerCurves, AreThoseOfTheMarchingCubesMeshOfSmoothFields) {
  for (const char* field : {"gyroid", "bubbles"}) {
    SCOPED_TRACE(field);
    expect_those_of_the_mesh(*field_scene(field, 26));
  }
}

TEST(ExactEulerCurves, AreThoseOfTheMarchingCubesMeshWithAnySpacing) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    expect_those_of_the_mesh(*testing::wave_scene({15, 14, 13}, {0.7, 1.3, 0.9}, seed));
  }
}

}  // namespace
}  // namespace deliso
