// Triangles that span what is no isosurface, of meshes whose topology is right.
#include "surface/repair/diagnosis/spanning_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "surface/certificate/exact_polygonization.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/deliso.h"
#include "surface/mesh/side_adjacency.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

double from_rod(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_norm(b - a), 0.0, 1.0);
  return distance(p, a + along * (b - a));
}

// A fork of two prongs, and a ball. Their meshes are those of marching cubes.
class ForkAndBall : public ::testing::Test {
 protected:
  ForkAndBall() {
    mesh_.built.mesh = exact_polygonization(scene_.surface()).mesh;
    for (const Vec3& p : mesh_.built.mesh.points) mesh_.component.push_back(*scene_.surface().component_at(p));
    mesh_.match = match_components(mesh_.built.mesh, mesh_.component, scene_.topology.components);
    fork_ = *scene_.surface().component_at(mesh_.built.mesh.points[vertex_near({4, 5, 5})]);
  }
  [[nodiscard]] std::uint32_t vertex_near(const Vec3& place) const {
    const std::vector<Vec3>& points = mesh_.built.mesh.points;
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const Vec3& p, const Vec3& q) {
      return distance(p, place) < distance(q, place);
    });
    return static_cast<std::uint32_t>(nearest - points.begin());
  }
  // Has some triangles of one prong reach over to the other.
  void stretch(std::ptrdiff_t count) {
    const std::uint32_t over = vertex_near({10, 17, 6});
    for (auto& triangle : mesh_.built.mesh.triangles) {
      if (count == 0) return;
      if (mesh_.component[triangle[0]] != fork_ || mesh_.built.mesh.points[triangle[0]].y > 8) continue;
      triangle[2] = over;
      --count;
    }
  }

  testing::Scene scene_{"fork and ball",
                        testing::sampled({40, 24, 12},
                                         [](const Vec3& p) {
                                           const double fork = std::min({from_rod(p, {4.2, 5.1, 5.4}, {20, 5, 5.6}),
                                                                         from_rod(p, {4.1, 17.2, 5.3}, {20, 17, 5.6}),
                                                                         from_rod(p, {20, 5, 5.6}, {20, 17, 5.6})});
                                           return std::max(2.3 - fork, 4 - distance(p, {33.2, 11.9, 5.7}));
                                         }),
                        0};
  MatchedMesh mesh_;
  std::uint32_t fork_ = 0;
};

TEST_F(ForkAndBall, HaveNone) {
  ASSERT_EQ(scene_.topology.components.size(), 2u);
  EXPECT_EQ(mesh_.match.agreement[0], Agreement::kExact);
  EXPECT_EQ(mesh_.match.agreement[1], Agreement::kExact);
  EXPECT_TRUE(spanning_triangles(mesh_, scene_.surface(), {false, false}, 1).empty());
}

TEST_F(ForkAndBall, HaveThoseThatReachFromProngToProng) {
  stretch(30);
  const std::vector<SpanningTriangle> found = spanning_triangles(mesh_, scene_.surface(), {false, false}, 1);
  ASSERT_FALSE(found.empty());
  for (const auto& [component, box] : found) {
    EXPECT_EQ(component, fork_);
    EXPECT_LT(box[1].first, 8);
    EXPECT_GT(box[1].last, 13);
  }
  std::vector<bool> done = {false, false};
  done[fork_] = true;
  EXPECT_TRUE(spanning_triangles(mesh_, scene_.surface(), done, 1).empty());
  mesh_.match.agreement[fork_] = Agreement::kNone;
  EXPECT_TRUE(spanning_triangles(mesh_, scene_.surface(), {false, false}, 1).empty());
}

// Where they are many, stage 2 is to refine the mesh first.
TEST_F(ForkAndBall, HaveNoneWhereTheyAreMany) {
  stretch(1000);
  EXPECT_TRUE(spanning_triangles(mesh_, scene_.surface(), {false, false}, 1).empty());
}

// Without a look for them the mesh of stage 1 kept one of this field, 2.6 voxels long.
TEST(SpanningTriangles, DoNotStay) {
  constexpr std::int32_t kSide = 40;
  const std::vector<double> noise = testing::smoothed_noise(kSide, 184, 8);
  const auto [low, high] = std::minmax_element(noise.begin(), noise.end());
  std::vector<std::int16_t> samples;
  samples.reserve(noise.size());
  for (const double value : noise) {
    samples.push_back(static_cast<std::int16_t>(std::lround(4000 * (value - *low) / (*high - *low))));
  }
  const ScalarGrid grid({kSide, kSide, kSide}, std::move(samples), {1, 1, 2});
  MeshingOptions options;
  options.keep_stage1_mesh = true;
  MeshingResult result = mesh_isosurface(grid, 2000.5, options);
  EXPECT_TRUE(is_proven(result.certificate));
  const testing::Scene scene("smoothed noise", grid, result.isovalue_used);
  MatchedMesh mesh;
  mesh.built.mesh.points = std::move(result.stage1_mesh->points);
  mesh.built.mesh.triangles = std::move(result.stage1_mesh->triangles);
  set_side_adjacency(mesh.built.mesh);
  for (const Vec3& p : mesh.built.mesh.points) {
    mesh.component.push_back(scene.surface().component_at(p).value_or(kNoComponent));
  }
  mesh.match = match_components(mesh.built.mesh, mesh.component, scene.topology.components);
  const std::vector<bool> done(scene.topology.components.size(), false);
  EXPECT_TRUE(spanning_triangles(mesh, scene.surface(), done, 1).empty());
}

}  // namespace
}  // namespace deliso
