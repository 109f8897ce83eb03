// A check that keeps what it knows must tell what a check of the whole mesh tells.
#include "surface/certificate/repeated_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

void expect_equal(const GeometryCheck& found, const GeometryCheck& expected) {
  EXPECT_EQ(found.mesh_off, expected.mesh_off);
  EXPECT_EQ(found.far_triangles, expected.far_triangles);
  EXPECT_EQ(found.far_parts, expected.far_parts);
  EXPECT_EQ(found.missed_numbers, expected.missed_numbers);
  EXPECT_EQ(found.missed_places, expected.missed_places);
  EXPECT_EQ(found.missed_points, expected.missed_points);
  EXPECT_EQ(found.off_vertices, expected.off_vertices);
}

// Moves a few vertices, drops and turns a few triangles, renumbers all.
void change(SurfaceMesh& mesh, const SurfaceMesh& whole, double share, Rng& rng) {
  for (Vec3& p : mesh.points) {
    if (rng.uniform() < share) p += 3 * Vec3{rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5};
  }
  std::erase_if(mesh.triangles, [&](const auto&) { return rng.uniform() < share; });
  for (auto& t : mesh.triangles) {
    if (rng.uniform() < share) std::swap(t[0], t[1]);
  }
  // Some that were dropped come back.
  for (const auto& t : whole.triangles) {
    if (rng.uniform() < share / 2) mesh.triangles.push_back(t);
  }
  std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + 7, mesh.triangles.end());
  std::reverse(mesh.points.begin(), mesh.points.end());
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(mesh.points.size()) - 1 - v;
  }
}

TEST(RepeatedCheck, TellsWhatACheckOfTheWholeTells) {
  std::size_t missed = 0, within = 0, far = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 12), testing::noise_scene({6, 7, 5}, 3)}) {
    SCOPED_TRACE(scene->name);
    for (const double reach : {0.3, 1.0}) {
      for (const int threads : {1, 3}) {
        if (threads == 3 && reach != 0.3) continue;
        Rng rng(static_cast<std::uint64_t>(10 * reach) + 100);
        const SurfaceMesh whole = exact_polygonization(scene->surface()).mesh;
        SurfaceMesh mesh = whole;
        const Promise promise{.max_distance = reach, .within_cells = reach == 0.3};
        const ExactSurface surface = scene->surface(threads);
        RepeatedCheck check(surface, promise);
        for (int round = 0; round < 5; ++round) {
          // The fourth time so much that all is looked at again.
          change(mesh, whole, round % 4 == 3 ? 0.2 : 0.004, rng);
          const GeometryCheck expected = check_geometry(mesh, surface, promise);
          expect_equal(check(mesh), expected);
          Promise wider = promise;
          wider.max_distance *= 1.3;
          expect_equal(check.again_within(wider, mesh), check_geometry(mesh, surface, wider));
          within += expected.missed_places.size();
          missed += expected.missed_numbers.size();
          far += expected.far_triangles.size();
        }
      }
    }
  }
  EXPECT_GT(missed, 100u);
  EXPECT_GT(within, 100u);
  EXPECT_GT(far, 100u);
}

// That nothing is off does not mean that a later mesh is near.
TEST(RepeatedCheck, BeginsAnewAfterAMeshThatIsNear) {
  const auto scene = testing::field_scene("sphere", 16);
  const ExactSurface surface = scene->surface();
  SurfaceMesh mesh = exact_polygonization(surface).mesh;
  const Promise promise{.max_distance = 0.5};
  RepeatedCheck check(surface, promise);
  EXPECT_TRUE(check(mesh).is_near());
  mesh.points[0] += Vec3{3, 3, 3};
  mesh.triangles.resize(mesh.triangles.size() - 20);
  const GeometryCheck expected = check_geometry(mesh, surface, promise);
  ASSERT_FALSE(expected.missed_numbers.empty());
  expect_equal(check(mesh), expected);
}

}  // namespace
}  // namespace deliso
