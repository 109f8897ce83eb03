// Handles that are in another place than the isosurface's, as many as it has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "surface/deliso.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/repair/diagnosis/euler_differences.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

constexpr std::int32_t kSize = 40;

double from_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_norm(b - a), 0.0, 1.0);
  return distance(p, a + along * (b - a));
}

double from_ring(const Vec3& p, const Vec3& center, double radius) {
  const Vec3 q = p - center;
  return std::hypot(std::hypot(q.x, q.y) - radius, q.z);
}

// A rod from corner to corner of the volume with a ring at its low end, or, mirrored, at the high one.
std::unique_ptr<testing::Scene> rod(bool is_mirrored) {
  std::vector<float> samples;
  for (std::int32_t z = 0; z < kSize; ++z) {
    for (std::int32_t y = 0; y < kSize; ++y) {
      for (std::int32_t x = 0; x < kSize; ++x) {
        Vec3 p{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (is_mirrored) p = Vec3{kSize - 1.0, kSize - 1.0, kSize - 1.0} - p;
        const double nearest =
            std::min(from_segment(p, {12.2, 11.9, 8.1}, {29.2, 29.1, 30.3}), from_ring(p, {9.1, 8.8, 8.2}, 4.3));
        samples.push_back(static_cast<float>(-nearest));
      }
    }
  }
  return std::make_unique<testing::Scene>("rod", ScalarGrid({kSize, kSize, kSize}, std::move(samples)), -2.05);
}

// A mesh of one scene, matched with the components of another.
std::shared_ptr<MatchedMesh> matched(const testing::Scene& of, const testing::Scene& with) {
  auto mesh = std::make_shared<MatchedMesh>();
  mesh->built.mesh = exact_polygonization(of.surface()).mesh;
  mesh->component.assign(mesh->built.mesh.points.size(), 0);
  mesh->match = match_components(mesh->built.mesh, mesh->component, with.topology.components);
  return mesh;
}

TEST(DisplacedHandles, AreFoundAndWhereTheyDiffer) {
  const auto scene = rod(false), mirrored = rod(true);
  ASSERT_EQ(scene->topology.components.size(), 1u);
  ASSERT_EQ(scene->topology.components[0].euler_characteristic, 0);
  const ExactSurfaceCache cache(scene->surface());
  EulerDifferences differences(cache);
  const auto right = matched(*scene, *scene), wrong = matched(*mirrored, *scene);
  ASSERT_EQ(wrong->match.agreement[0], Agreement::kExact);
  differences.find_displaced(*right, {false}, 64);
  EXPECT_EQ(right->match.agreement[0], Agreement::kExact);
  differences.find_displaced(*wrong, {true}, 64);
  differences.find_displaced(*wrong, {false}, 1);
  EXPECT_EQ(wrong->match.agreement[0], Agreement::kExact);
  differences.find_displaced(*wrong, {false}, 64);
  EXPECT_EQ(wrong->match.agreement[0], Agreement::kDisplaced);
  EXPECT_EQ(wrong->match.error, 1);
  // Both where a handle is missing and where there is one too many, and nowhere between.
  bool at_low_end = false, at_high_end = false;
  for (const auto& [x, y, z] : differences.find(wrong, {false}, {64, false})[0].likely) {
    at_low_end = at_low_end || (x.last < 17 && y.last < 17 && z.last < 17);
    at_high_end = at_high_end || (x.first > 22 && y.first > 22 && z.first > 22);
    EXPECT_TRUE(z.last < 17 || z.first > 22) << z.first << " to " << z.last;
  }
  EXPECT_TRUE(at_low_end);
  EXPECT_TRUE(at_high_end);
}

// Noise that twice has been averaged along each axis, in bytes.
ScalarGrid bytes_of_noise(std::int32_t size, std::uint64_t seed, const Vec3& spacing = {1, 1, 1}) {
  std::vector<std::uint8_t> samples;
  for (const double value : testing::smoothed_noise(size, seed, 2)) {
    samples.push_back(static_cast<std::uint8_t>(std::lround(128 + 100 * (value - 0.5))));
  }
  return {{size, size, size}, std::move(samples), spacing};
}

// Of these fields a mesh of repair had the right topology with a handle in a wrong place. Its Euler curves told.
TEST(DisplacedHandles, OfNoiseAreMended) {
  for (const std::uint64_t seed : {4u, 17u, 68u}) {
    SCOPED_TRACE(seed);
    const ScalarGrid grid = bytes_of_noise(32, seed);
    MeshingResult result = mesh_isosurface(grid, 128.5, {});
    const testing::Scene scene("smoothed noise", grid, result.isovalue_used);
    EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic);
    EXPECT_EQ(result.repair.components_displaced, 0);
    SurfaceMesh mesh;
    mesh.points = std::move(result.mesh.points);
    mesh.triangles = std::move(result.mesh.triangles);
    set_side_adjacency(mesh);
    const ExactPolygonization exact = exact_polygonization(scene.surface());
    const auto curves_of = [&](const SurfaceMesh& whole) {
      const std::vector<std::uint32_t> one_part(whole.points.size(), 0);
      return euler_curves(whole, one_part, 1, {1, 1, 1}, scene.grid.dims()).front();
    };
    for (const auto& jumps : jumps_between(curves_of(mesh), curves_of(exact.mesh))) EXPECT_TRUE(jumps.empty());
  }
}

// No round mends this one: eight of them had twice as many samples, and a handle in a wrong place all the same.
TEST(DisplacedHandles, ThatStayEndRepairAfterTwoRounds) {
  const MeshingResult result = mesh_isosurface(bytes_of_noise(32, 11, {1, 1, 1.57}), 128.5, {});
  EXPECT_EQ(result.repair.components_displaced, 1);
  EXPECT_LE(result.repair.rounds, 3);
  EXPECT_EQ(result.repair.components_polygonized, 0);
  EXPECT_TRUE(is_proven(result.certificate));
}

}  // namespace
}  // namespace deliso
