// What of the isosurface a mesh misses within cells, against a search of all triangles for the points of a finer grid.
#include "surface/certificate/cells/missed_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "delaunay/base/stopwatch.h"
#include "raycast/voxel_intersection.h"
#include "surface/certificate/exact_polygonization.h"
#include "tests/support/mesh_distance.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::Scene;

// The farthest crossing of the isosurface with a grid ten times as fine, in one cell.
double farthest_in(const Scene& scene, const CellIndex& cell, const SurfaceMesh& mesh) {
  constexpr int kTimes = 10;
  const CellCorners field = relative_to(scene.grid.cell(cell[0], cell[1], cell[2]), scene.isovalue);
  const Vec3 low{double(cell[0]), double(cell[1]), double(cell[2])};
  double farthest = 0;
  for (int n = 0; n < (kTimes + 1) * (kTimes + 1) * (kTimes + 1); ++n) {
    const Vec3 p = Vec3{double(n % (kTimes + 1)), double(n / (kTimes + 1) % (kTimes + 1)),
                        double(n / (kTimes + 1) / (kTimes + 1))} /
                   kTimes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] > 1 - 0.5 / kTimes) continue;
      Vec3 q = p;
      q[axis] += 1.0 / kTimes;
      const double before = relative_value(field, p), behind = relative_value(field, q);
      if ((before >= 0) == (behind >= 0)) continue;
      const Vec3 crossing = p + before / (before - behind) * (q - p);
      farthest = std::max(farthest, testing::distance_to(scaled(scene.isosurface->step(), low + crossing), mesh));
    }
  }
  return farthest;
}

// Meshes with holes, made of triangles smaller and larger than the distance.
TEST(MissedPlaces, AreFoundInEveryCellThatHasThem) {
  Rng rng(9);
  int missed = 0, near = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 7), testing::noise_scene({5, 5, 4}, 3, {1, 1.5, 1})}) {
    SCOPED_TRACE(scene->name);
    const ExactSurface surface = scene->surface();
    const std::vector<std::uint64_t> cells = crossed_cells(surface);
    for (const double most : {0.1, 0.3, 0.9}) {
      SurfaceMesh mesh = exact_polygonization(surface).mesh;
      std::erase_if(mesh.triangles, [&](const auto&) { return rng.uniform() < 0.2; });
      const std::vector<MissedPlace> places = missed_places(mesh, surface, most, cells);
      EXPECT_EQ(places, missed_places(mesh, scene->surface(3), most, cells));
      for (const std::uint64_t cell : cells) {
        const auto place =
            std::find_if(places.begin(), places.end(), [&](const auto& one) { return one.cell == cell; });
        const double farthest = farthest_in(*scene, sample_of({cell, 0, 0, 0}, scene->grid.dims()), mesh);
        // Points farther by less than the largest box that is not divided may be missed.
        EXPECT_TRUE(place != places.end() || farthest <= 1.0251 * most) << cell;
        if (place == places.end()) {
          ++near;
          continue;
        }
        ++missed;
        EXPECT_GT(testing::distance_to(place->position, mesh), most);
        EXPECT_NEAR(scene->isosurface->value(place->position), 0, 1e-9) << cell;
      }
    }
  }
  EXPECT_GT(missed, 30);
  EXPECT_GT(near, 60);
}

TEST(MissedPlaces, AreNotLookedForOnComponentsThatAreDropped) {
  const auto scene = testing::field_scene("linked_tori", 24);
  ExactSurface surface = scene->surface();
  SurfaceMesh mesh = exact_polygonization(surface).mesh;
  mesh.triangles.resize(1);
  const std::size_t all = missed_places(mesh, surface, 0.5, crossed_cells(surface)).size();
  surface.is_dropped = {1, 0};
  const std::vector<std::uint64_t> kept = crossed_cells(surface);
  EXPECT_LT(missed_places(mesh, surface, 0.5, kept).size(), 0.7 * double(all));
  for (const std::uint64_t cell : kept) {
    for (const EdgeCrossing& crossing : scene->topology.crossings) {
      EXPECT_FALSE(crossing.sample == cell && crossing.component == 0);
    }
  }
}

// Where others pass through a cell of theirs, too, and no triangle is near.
TEST(MissedPlaces, AreThoseOfComponentsKeptInCellsOfBoth) {
  const auto scene = testing::noise_scene({7, 6, 6}, 5, {1, 1, 1});
  ExactSurface surface = scene->surface();
  SurfaceMesh mesh = exact_polygonization(surface).mesh;
  mesh.triangles.resize(1);
  const std::vector<std::uint64_t> all = crossed_cells(surface);
  surface.is_dropped.resize(scene->topology.components.size());
  ASSERT_GT(surface.is_dropped.size(), 5u);
  for (std::size_t c = 0; c < surface.is_dropped.size(); c += 2) surface.is_dropped[c] = 1;
  const std::vector<std::uint64_t> kept = crossed_cells(surface);
  for (std::uint8_t& is_dropped : surface.is_dropped) is_dropped = is_dropped == 0 ? 1 : 0;
  const std::vector<std::uint64_t> others = crossed_cells(surface);
  for (std::uint8_t& is_dropped : surface.is_dropped) is_dropped = is_dropped == 0 ? 1 : 0;
  EXPECT_GT(kept.size() + others.size(), all.size() + 5);  // cells of both
  const Box3 around_mesh = [&] {
    Box3 box;
    for (const std::uint32_t v : mesh.triangles[0]) box.extend(mesh.points[v]);
    return box;
  }();
  const std::vector<MissedPlace> places = missed_places(mesh, surface, 0.3, kept);
  for (const std::uint64_t cell : kept) {
    const auto place = std::find_if(places.begin(), places.end(), [&](const auto& one) { return one.cell == cell; });
    const CellIndex at = sample_of({cell, 0, 0, 0}, scene->grid.dims());
    const Vec3 middle = scaled(scene->isosurface->step(), {at[0] + 0.5, at[1] + 0.5, at[2] + 0.5});
    if (distance(middle, around_mesh.clamp(middle)) < 1.5) continue;
    ASSERT_NE(place, places.end()) << cell;
    const auto component = surface.component_at(place->position);
    ASSERT_TRUE(component.has_value());
    EXPECT_EQ(surface.is_dropped[*component], 0) << cell;
  }
}

// For so small a distance one cell at the boundary of the mesh takes half a minute.
TEST(MissedPlaces, EndWithinACellWhenTheRunIsToStop) {
  const Scene scene("plane", testing::sampled({3, 3, 3}, [](const Vec3& p) { return p.x + 0.3 * p.y - 0.2 * p.z; }),
                    1.15);
  const SurfaceMesh mesh = exact_polygonization(scene.surface()).mesh;
  std::atomic<bool> stop{false};
  const Controls controls({}, &stop, {});
  ExactSurface surface = scene.surface();
  surface.controls = &controls;
  const std::vector<std::uint64_t> cells = crossed_cells(surface);
  std::thread caller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  const Stopwatch watch;
  static_cast<void>(missed_places(mesh, surface, 1e-8, cells));
  EXPECT_LT(watch.seconds(), 10);
  caller.join();
}

}  // namespace
}  // namespace deliso
