// Stage 2 restarts where triangles came to meet.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "surface/intersection/self_intersection.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/refine/guard/clearances.h"
#include "surface/refine/guard/refinement_crossings.h"
#include "surface/refine/refine.h"
#include "surface/refine/refine_loop.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::Scene;

// A hill, a coarse mesh of it, and a small triangle that crosses the hill's surface where the mesh does not reach yet.
// The pole heights do not know of it, so the guard lets the mesh grow through it.
struct CrossedHill {
  std::unique_ptr<Scene> scene;
  SurfaceMesh mesh;
};
double height_of_hill(double x, double y) { return 1 + 3 * std::exp(-((x - 6) * (x - 6) + (y - 6) * (y - 6)) / 8); }

CrossedHill crossed_hill(const Vec3& place) {
  constexpr std::uint32_t kSquares = 4;
  std::vector<float> samples;
  for (int z = 0; z < 7; ++z) {
    for (int y = 0; y < 13; ++y) {
      for (int x = 0; x < 13; ++x) samples.push_back(static_cast<float>(height_of_hill(x, y) - z));
    }
  }
  CrossedHill hill{
      std::make_unique<Scene>("hill", ScalarGrid({13, 13, 7}, SampleArray<float>(std::move(samples))), 0.0123), {}};
  SurfaceMesh& mesh = hill.mesh;
  for (std::uint32_t j = 0; j <= kSquares; ++j) {
    for (std::uint32_t i = 0; i <= kSquares; ++i) {
      const double x = 3.0 * i, y = 3.0 * j;
      mesh.points.push_back({x, y, height_of_hill(x, y) - hill.scene->isovalue});
    }
  }
  for (std::uint32_t j = 0; j < kSquares; ++j) {
    for (std::uint32_t i = 0; i < kSquares; ++i) {
      const std::uint32_t at = j * (kSquares + 1) + i;
      mesh.triangles.push_back({at, at + 1, at + kSquares + 2});
      mesh.triangles.push_back({at, at + kSquares + 2, at + kSquares + 1});
    }
  }
  const auto small = static_cast<std::uint32_t>(mesh.points.size());
  for (const Vec3& corner : {Vec3{0, 0, 0.2}, Vec3{0.1, 0.1, -0.15}, Vec3{-0.1, -0.1, -0.15}}) {
    mesh.points.push_back(place + corner);
  }
  mesh.triangles.push_back({small, small + 1, small + 2});
  set_side_adjacency(mesh);
  mesh.pole_heights.assign(mesh.points.size(), 1000);
  return hill;
}

constexpr std::array<Vec3, 3> kPlaces = {Vec3{7.1, 6.8, 0}, Vec3{4.9, 6.9, 0}, Vec3{5.1, 4.7, 0}};

CrossedHill crossed_hill_at(Vec3 place) {
  place.z = height_of_hill(place.x, place.y);
  return crossed_hill(place);
}

std::int64_t meeting_triangles(const SurfaceMesh& mesh) {
  const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, 10);
  return found.crossing_pairs + found.touching_pairs;
}

RefineOptions finest_options() {
  RefineOptions options;
  options.r_min = 0.3;
  return options;
}

TEST(RefineRestart, NothingMeetsAfterwards) {
  for (const std::size_t slab_triangles : {std::size_t{10}, std::size_t{100000}}) {
    for (const Vec3& place : kPlaces) {
      SCOPED_TRACE(slab_triangles);
      auto [scene, mesh] = crossed_hill_at(place);
      ASSERT_EQ(meeting_triangles(mesh), 0);
      RefineOptions options = finest_options();
      options.slab_triangles = slab_triangles;
      const Isosurface& isosurface = *scene->isosurface;
      const auto run = [&](SurfaceMesh& refined) {
        Controls controls(BudgetParameters{}, nullptr, {});
        RefineStats stats;
        refine_geometry(refined, isosurface, options, controls, stats);
        return stats;
      };
      SurfaceMesh unchecked = mesh;
      options.restart_at_crossings = false;
      EXPECT_EQ(run(unchecked).restarts, 0);
      EXPECT_GT(meeting_triangles(unchecked), 0);
      options.restart_at_crossings = true;
      const RefineStats stats = run(mesh);
      EXPECT_GT(stats.restarts, 0);
      EXPECT_GT(stats.insertions, 30);
      EXPECT_EQ(meeting_triangles(mesh), 0);
      EXPECT_EQ(testing::surface_mesh_defect(mesh), "");
    }
  }
}

// A crossed hill after one pass without the final check for triangles that meet.
enum class Clearances { kFromPoles, kZero };
RefinementMesh refined_once(const Vec3& place, Clearances clearances, RefineStats& stats) {
  const auto [scene, mesh] = crossed_hill_at(place);
  RefinementPart part;
  part.mesh = RefinementMesh(mesh);
  set_clearances(part.mesh);
  if (clearances == Clearances::kZero) clear_all_clearances(part.mesh);
  const RefineOptions options = finest_options();
  Controls controls(BudgetParameters{}, nullptr, {});
  RefineLoop(part, *scene->isosurface, options, stats).measure_all(1);
  RefineLoop(part, *scene->isosurface, options, stats).run(controls, 1);
  return std::move(part.mesh);
}

TEST(RefineRestart, WithClearancesOfZeroNoTrianglesComeToMeet) {
  for (const Vec3& place : kPlaces) {
    RefineStats stats;
    const RefinementMesh mesh = refined_once(place, Clearances::kZero, stats);
    EXPECT_GT(stats.insertions, 30);
    const SelfIntersections found = meeting_pairs(mesh, 1);
    EXPECT_EQ(found.crossing_pairs + found.touching_pairs, 0);
  }
}

TEST(RefineRestart, WhatWasRenewedHoldsAllPairsThatCameToMeet) {
  for (const Vec3& place : kPlaces) {
    RefineStats stats;
    const RefinementMesh mesh = refined_once(place, Clearances::kFromPoles, stats);
    const SelfIntersections all = meeting_pairs(mesh, 1);
    const SelfIntersections renewed = meeting_pairs_of_renewed(mesh, 1);
    EXPECT_GT(all.crossing_pairs, 0);
    EXPECT_EQ(renewed.crossing_pairs, all.crossing_pairs);
    EXPECT_EQ(renewed.touching_pairs, all.touching_pairs);
  }
}

}  // namespace
}  // namespace deliso
