#include "surface/repair/finish/nearer_cubes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/certificate/certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/intersection/self_intersection.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

std::int64_t off(const SurfaceMesh& mesh, const testing::Scene& scene, double max_distance) {
  const GeometryCheck check =
      check_distances(mesh, scene.surface(), {.max_distance = max_distance, .within_cells = true});
  return check.mesh_off + std::ssize(check.missed_points);
}

TEST(NearerCubes, OfNoiseLeaveLittleFarAndDoNotCross) {
  Rng rng(8);
  for (int field = 0; field < 2; ++field) {
    const testing::Scene scene("noise", testing::noise_grid({10, 10, 10}, {1, 1, 1}, rng), 127.5);
    const std::vector<bool> all(scene.topology.components.size(), true);
    const ExactPolygonization whole = exact_polygonization(scene.surface());
    const ExactPolygonization near = nearer_cubes(all, scene.surface(), {.max_distance = 0.3});
    EXPECT_EQ(certify(to_world(near.mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic);
    EXPECT_EQ(self_intersections(near.mesh.points, near.mesh.triangles).crossing_pairs, 0);
    EXPECT_LT(10 * off(near.mesh, scene, 0.3), off(whole.mesh, scene, 0.3)) << field;
    // Not all cells were divided.
    EXPECT_LT(near.mesh.points.size(), 5 * whole.mesh.points.size()) << field;
    const ExactPolygonization again = nearer_cubes(all, scene.surface(2), {.max_distance = 0.3});
    EXPECT_EQ(again.mesh.points, near.mesh.points);
    EXPECT_EQ(again.mesh.triangles, near.mesh.triangles);
  }
}

// The cells of samples are divided, whatever is near; of the wanted components alone.
TEST(NearerCubes, AreDividedAtSamples) {
  const auto scene = testing::field_scene("shells", 24);
  const std::size_t count = scene->topology.components.size();
  ASSERT_GT(count, 1u);
  std::vector<bool> first(count, false);
  first[0] = true;
  const ExactPolygonization whole = nearer_cubes(first, scene->surface(), {.max_distance = 4});
  for (const std::uint32_t c : whole.component) EXPECT_EQ(c, 0u);
  const std::vector<Vec3> samples = {whole.mesh.points[10]};
  const ExactPolygonization near = nearer_cubes(first, scene->surface(), {.max_distance = 4, .samples = samples});
  EXPECT_GT(near.mesh.points.size(), whole.mesh.points.size());
  EXPECT_LT(near.mesh.points.size(), whole.mesh.points.size() + 100);
}

}  // namespace
}  // namespace deliso
