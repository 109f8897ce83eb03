// Patches around bad triangles: their boxes hold them, do not meet those of other patches, and are few where they
// crowd.
#include "surface/shape/patches.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/base/exact_surface.h"
#include "tests/support/mesh_fields.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

// Slivers in two places far apart: `count` that begin in one voxel, and one alone.
SurfaceMesh slivers(int count) {
  SurfaceMesh mesh;
  const auto add = [&](const Vec3& p) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {p, p + Vec3{0.02, 0, 0}, p + Vec3{0.01, 1e-4, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < count; ++i) add({5.1 + 0.8 * i / count, 5.5, 5.5});
  add({25.5, 25.5, 25.5});
  return mesh;
}

TEST(Patches, BadTrianglesOfOneVoxelShareABox) {
  const ScalarGrid grid = testing::sampled({32, 32, 32}, [](const Vec3& p) { return p.z; });
  const Isosurface isosurface(grid, 5.5, SearchOptions());
  const IsosurfaceTopology topology = exact_topology(grid, 5.5);
  const ExactSurface surface{isosurface, topology};
  for (const int count : {1, 7, 1000}) {
    const SurfaceMesh mesh = slivers(count);
    std::vector<std::uint32_t> bad(mesh.triangles.size());
    std::iota(bad.begin(), bad.end(), 0u);
    const std::vector<PatchPlan> plans = plan_patches(mesh, bad, 3, surface);
    ASSERT_EQ(plans.size(), 2u);
    EXPECT_EQ(plans[0].bad.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(plans[1].bad, std::vector<std::uint32_t>{static_cast<std::uint32_t>(count)});
    // As many boxes as triangles made the work grow with the square of their number.
    EXPECT_EQ(plans[0].room.boxes().size(), 1u);
    for (const PatchPlan& plan : plans) {
      std::vector<std::uint32_t> near;
      for (const std::uint32_t t : plan.bad) EXPECT_TRUE(plan.room.holds(box_of(mesh, t), near));
      EXPECT_EQ(plan.triangles, plan.bad);
    }
    for (const Box3& a : plans[0].room.boxes()) {
      for (const Box3& b : plans[1].room.boxes()) EXPECT_FALSE(a.meets(b));
    }
  }
}

// As many triangles as before, but a vertex in them is another: the old one stayed among the mesh's points, and
// crossings near it seemed to be near the mesh.
TEST(Patches, NoVertexWithoutTrianglesIsPutBack) {
  SurfaceMesh mesh;
  mesh.points = {{1, 1, 1}, {3, 1, 1}, {2, 3, 1}, {2, 2, 2}};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  PatchPlan plan;
  plan.room.add({{0, 0, 0}, {4, 4, 4}});
  plan.triangles = {0, 1, 2};
  const std::vector<PatchPlan> plans = {plan};
  ShapeStats stats;
  work_in_patches(mesh, plans, 1, stats, [](NumberedPatch& taken, const PatchPlan&, ShapeStats&) {
    PatchStep step;
    step.removed = {0, 1, 2};
    step.added = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}};
    step.vertex = 4;
    step.point = {2, 2, 0};
    taken.patch.apply(step);
  });
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.points, (std::vector<Vec3>{{1, 1, 1}, {3, 1, 1}, {2, 3, 1}, {2, 2, 0}}));
}

}  // namespace
}  // namespace deliso
