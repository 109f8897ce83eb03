#include "surface/mesh/component_measures.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

TEST(ComponentMeasures, ACubeHasItsAreaAndVolumeFarFromTheOriginToo) {
  for (const double far : {0.0, 1e6}) {
    TriangleMesh mesh = testing::tetrahedron_mesh();
    for (Vec3& p : mesh.points) p = p + Vec3{far, far, -far};
    const auto measures = component_measures(mesh, mesh_topology(mesh));
    ASSERT_EQ(measures.size(), 1u);
    EXPECT_NEAR(measures[0].area, 1.5 + std::numbers::sqrt3 / 2, 1e-9);
    ASSERT_TRUE(measures[0].enclosed_volume);
    EXPECT_NEAR(*measures[0].enclosed_volume, 1.0 / 6, 1e-9);
    EXPECT_EQ(measures[0].box.low, (Vec3{far, far, -far}));
    EXPECT_EQ(measures[0].box.high, (Vec3{far + 1, far + 1, -far + 1}));
  }
}

TEST(ComponentMeasures, CavitiesCountAgainstTheirSolids) {
  TriangleMesh mesh = testing::sphere_mesh(5, 2);
  TriangleMesh inner = testing::sphere_mesh(5, 1);
  for (auto& [a, b, c] : inner.triangles) std::swap(b, c);
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), inner.points.begin(), inner.points.end());
  for (const auto& [a, b, c] : inner.triangles) mesh.triangles.push_back({base + a, base + b, base + c});
  const auto measures = component_measures(mesh, mesh_topology(mesh));
  ASSERT_EQ(measures.size(), 2u);
  constexpr double kBall = 4 * std::numbers::pi / 3;
  EXPECT_NEAR(*measures[0].enclosed_volume, 8 * kBall, 0.1);
  EXPECT_NEAR(*measures[1].enclosed_volume, -kBall, 0.02);
  const ComponentMeasure whole = whole_measure(measures);
  EXPECT_NEAR(whole.area, 5 * 4 * std::numbers::pi, 0.2);
  EXPECT_NEAR(*whole.enclosed_volume, 7 * kBall, 0.1);
}

TEST(ComponentMeasures, AMeshWithABoundaryEnclosesNoVolume) {
  TriangleMesh mesh = testing::sphere_mesh(3);
  mesh.triangles.pop_back();
  const auto measures = component_measures(mesh, mesh_topology(mesh));
  EXPECT_FALSE(measures[0].enclosed_volume);
  EXPECT_FALSE(whole_measure(measures).enclosed_volume);
  EXPECT_FALSE(whole_measure({}).enclosed_volume);
}

}  // namespace
}  // namespace deliso
