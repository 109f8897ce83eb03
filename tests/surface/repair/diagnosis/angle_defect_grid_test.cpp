// Pieces that one of two meshes has and the other has not must be found where they are; other triangulations of the
// same surface must give nothing.
#include "surface/repair/diagnosis/angle_defect_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/certificate/exact_polygonization.h"
#include "surface/deliso.h"
#include "surface/mesh/side_adjacency.h"
#include "tests/support/raycast_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::Scene;

constexpr std::size_t kManyPlaces = 1000;

bool takes_all(std::uint32_t) { return true; }

bool holds(const IndexBox& place, const Vec3& p, double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] < place[axis].first - margin || p[axis] > place[axis].last + margin) return false;
  }
  return true;
}

// Positive within balls around some centers.
std::unique_ptr<Scene> balls(const std::vector<Vec3>& centers, double radius, const Dims& dims) {
  const auto depth = [&](double i, double j, double k) {
    double value = -1e9;
    for (const Vec3& c : centers) value = std::max(value, radius - distance({i, j, k}, c));
    return static_cast<float>(value);
  };
  return std::make_unique<Scene>("balls", testing::sampled_grid<float>(dims, {1, 1, 1}, depth), 0.0);
}

ExactPolygonization polygonized(const Scene& scene) { return exact_polygonization(scene.surface()); }

void subtract(AngleDefectGrid& difference, const Scene& scene, const SurfaceMesh& mesh,
              const std::function<bool(std::uint32_t)>& is_taken) {
  AngleDefectGrid other(scene.grid.dims(), scene.isosurface->step());
  other.add(mesh, is_taken);
  difference.subtract(other);
}

TEST(AngleDefectGrid, FindsPiecesThatCancelInAll) {
  const std::vector<Vec3> centers = {{9.3, 10.1, 11.2}, {37.6, 12.4, 30.8}, {20.2, 35.1, 21.7}};
  const auto scene = balls(centers, 3.2, {48, 46, 44});
  const auto [mesh, component] = polygonized(*scene);
  ASSERT_EQ(scene->topology.components.size(), centers.size());
  // Which ball each component is.
  std::vector<Vec3> center_of(centers.size());
  for (std::size_t v = 0; v < component.size(); ++v) {
    const Vec3& p = mesh.points[v];
    center_of[component[v]] = *std::min_element(centers.begin(), centers.end(), [&](const Vec3& a, const Vec3& b) {
      return squared_distance(a, p) < squared_distance(b, p);
    });
  }
  AngleDefectGrid difference(scene->grid.dims(), scene->isosurface->step());
  difference.add(mesh, [&, &component = component](std::uint32_t v) { return component[v] != 0; });
  subtract(difference, *scene, mesh, [&, &component = component](std::uint32_t v) { return component[v] != 1; });
  const std::vector<IndexBox> too_much = difference.places(true, kManyPlaces),
                              missing = difference.places(false, kManyPlaces);
  ASSERT_EQ(too_much.size(), 1u);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_TRUE(holds(too_much.front(), center_of[1], 2));
  EXPECT_TRUE(holds(missing.front(), center_of[0], 2));
}

TEST(AngleDefectGrid, FindsHandles) {
  // A torus and a ball as large.
  const Vec3 center{19.7, 20.2, 12.4};
  const auto depth = [&](double i, double j, double k) {
    const Vec3 d = Vec3{i, j, k} - center;
    return static_cast<float>(1.8 - std::hypot(std::hypot(d.x, d.y) - 3.4, d.z));
  };
  const auto torus =
      std::make_unique<Scene>("torus", testing::sampled_grid<float>({40, 40, 26}, {1, 1, 1}, depth), 0.0);
  const auto ball = balls({center}, 5, {40, 40, 26});
  ASSERT_EQ(torus->topology.components.front().euler_characteristic, 0);
  AngleDefectGrid difference(torus->grid.dims(), torus->isosurface->step());
  difference.add(polygonized(*torus).mesh, takes_all);
  subtract(difference, *ball, polygonized(*ball).mesh, takes_all);
  EXPECT_TRUE(difference.places(true, kManyPlaces).empty());
  const std::vector<IndexBox> missing = difference.places(false, kManyPlaces);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_TRUE(holds(missing.front(), center, 2));
}

TEST(AngleDefectGrid, OtherTrianglesOfTheSameSurfaceAreNoDifference) {
  for (const char* name : {"gyroid", "bubbles", "double_torus", "blobs"}) {
    SCOPED_TRACE(name);
    const auto scene = testing::field_scene(name, 40);
    const MeshingResult result = mesh_isosurface(scene->grid, scene->isovalue, {});
    SurfaceMesh mesh;
    const Vec3& step = scene->isosurface->step();
    for (const Vec3& p : result.mesh.points) mesh.points.push_back(from_world(p, *scene->isosurface));
    mesh.triangles = result.mesh.triangles;
    set_side_adjacency(mesh);
    AngleDefectGrid difference(scene->grid.dims(), step);
    difference.add(mesh, takes_all);
    ASSERT_FALSE(difference.places(true, kManyPlaces).empty() && difference.places(false, kManyPlaces).empty());
    subtract(difference, *scene, polygonized(*scene).mesh, takes_all);
    EXPECT_TRUE(difference.places(true, kManyPlaces).empty());
    EXPECT_TRUE(difference.places(false, kManyPlaces).empty());
  }
}

TEST(AngleDefectGrid, GivesTheLargestDifferencesFirstAndNoMoreThanAskedFor) {
  const std::vector<Vec3> centers = {{8, 9, 10}, {40, 9, 10}, {8, 40, 10}, {40, 40, 35}};
  const auto scene = balls(centers, 2.6, {50, 50, 46});
  const auto [mesh, component] = polygonized(*scene);
  AngleDefectGrid sums(scene->grid.dims(), scene->isosurface->step());
  sums.add(mesh, takes_all);
  // Once more.
  sums.add(mesh, [&, &component = component](std::uint32_t v) { return component[v] == 2; });
  const std::vector<IndexBox> all = sums.places(true, kManyPlaces);
  ASSERT_EQ(all.size(), centers.size());
  const auto of_second = std::find(component.begin(), component.end(), 2u);
  ASSERT_NE(of_second, component.end());
  EXPECT_TRUE(holds(all.front(), mesh.points[static_cast<std::size_t>(of_second - component.begin())], 5));
  const std::vector<IndexBox> two = sums.places(true, 2);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0], all[0]);
  EXPECT_EQ(two[1], all[1]);
}

}  // namespace
}  // namespace deliso
