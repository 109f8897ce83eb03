// The crossings that a mesh does not cover, compared with a measurement of all triangles; and the cells around them.
#include "surface/repair/finish/missed_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "surface/base/parallel_blocks.h"
#include "surface/repair/diagnosis/exact_polygonization.h"
#include "surface/search/coverage_query.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;

// Marching cubes with a hole of some voxels.
SurfaceMesh with_hole(const testing::Scene& scene, const Vec3& center, double radius) {
  SurfaceMesh mesh = exact_polygonization(scene.surface()).mesh;
  std::erase_if(mesh.triangles, [&](const auto& t) { return distance(mesh.points[t[0]], center) < radius; });
  mesh.neighbours.clear();
  return mesh;
}

TEST(MissedCrossings, AreTheCrossingsInTheBoxesThatTheMeshDoesNotCover) {
  const auto scene = field_scene("torus", 64);
  const Vec3 center = crossing_position(scene->grid, scene->topology.crossings[500]);
  const SurfaceMesh mesh = with_hole(*scene, center, 4);
  const auto around = [](const Vec3& p, double r) { return Box3{p - Vec3{r, r, r}, p + Vec3{r, r, r}}; };
  const Vec3 elsewhere = crossing_position(scene->grid, scene->topology.crossings[5]);
  const std::vector<Box3> boxes = {around(center, 2), around(center + Vec3{1, 1, 0}, 2), around(elsewhere, 2)};
  ASSERT_GT(mesh.triangles.size(), kBlockSize);
  const CoverageQuery cover(mesh);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < scene->topology.crossings.size(); ++i) {
    const Vec3 p = crossing_position(scene->grid, scene->topology.crossings[i]);
    std::uint32_t guess = 0;
    const bool is_asked = std::any_of(boxes.begin(), boxes.end(), [&](const Box3& box) { return box.contains(p); });
    if (is_asked && !cover.covers(p, guess)) expected.push_back(i);
  }
  EXPECT_GT(expected.size(), 10u);
  for (const int threads : {1, 3}) {
    EXPECT_EQ(missed_crossings(mesh, boxes, scene->surface(threads)), expected);
  }
  EXPECT_TRUE(missed_crossings(mesh, {}, scene->surface()).empty());
  const SurfaceMesh whole = with_hole(*scene, center, 0);
  EXPECT_TRUE(missed_crossings(whole, boxes, scene->surface()).empty());
}

TEST(MissedCrossings, HaveTheActiveCellsAroundThem) {
  const auto scene = field_scene("gyroid", 16);
  const CellLevels cells(*scene->isosurface);
  for (const std::uint32_t crossing : {0u, 100u, 300u}) {
    ASSERT_LT(crossing, scene->topology.crossings.size());
    const Vec3 p = crossing_position(scene->grid, scene->topology.crossings[crossing]);
    std::set<CellName> expected;
    scene->topology.index.for_each_active_cell([&](const CellIndex& cell, unsigned) {
      bool is_near = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        is_near = is_near && std::abs(cell[axis] - static_cast<std::int32_t>(p[axis])) <= 3;
      }
      if (is_near) expected.insert(cells.name(cell));
    });
    const std::vector<std::uint32_t> some = {crossing};
    const std::vector<CellName> found = cells_around(some, scene->surface(), cells);
    EXPECT_EQ(std::set<CellName>(found.begin(), found.end()), expected);
  }
}

}  // namespace
}  // namespace deliso
