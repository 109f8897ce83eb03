// Triangles at the faces of the box: inner vertices a hair off a face, and edges of the boundary that cut one off.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/shape/patch.h"
#include "surface/shape/shape_steps.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

// A few plane waves, flat boxes: the isosurface leaves the box at all angles, and lies along its faces here and there.
ScalarGrid flat_waves(std::uint64_t seed) {
  Rng rng(seed);
  Dims dims{};
  for (std::int32_t& dim : dims) dim = 12 + static_cast<std::int32_t>(rng.below(16));
  Vec3 spacing{1, 1, 1};
  spacing[rng.below(3)] = 0.1;
  struct Wave {
    Vec3 direction;
    double height, phase;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 4; ++i) {
    Vec3 direction{rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5};
    direction = direction * (2 * std::numbers::pi / (norm(direction) * (5 + 15 * rng.uniform())));
    waves.push_back({direction, rng.uniform(), 2 * std::numbers::pi * rng.uniform()});
  }
  const double level = rng.uniform() - 0.5;
  return testing::sampled(
      dims,
      [&](const Vec3& p) {
        double sum = level;
        for (const Wave& wave : waves) sum += wave.height * std::cos(dot(wave.direction, p) + wave.phase);
        return sum;
      },
      spacing);
}

// In each of the first a face of the box cut the mesh off where nothing could be inserted, so a few triangles were too
// far, and finer cubes took the place of all; in the last an inner vertex was a hair off a face.
TEST(BoundarySteps, FlatBoxesGetGoodAnglesWithoutFinerCubes) {
  for (const std::uint64_t seed : {44U, 61U, 130U, 141U, 149U, 155U, 158U, 214U}) {
    const ScalarGrid grid = flat_waves(seed);
    const MeshingResult result = mesh_isosurface(grid, 0, {});
    EXPECT_TRUE(is_proven(result.certificate)) << seed;
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven) << seed;
    // From marching cubes of the volume at most, where repair has given up.
    EXPECT_EQ(result.repair.components_polygonized, result.repair.components_given_up) << seed;
    EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 8) << seed;
  }
}

// The isosurface x = 4.3, facing greater x, in a box whose face z = 0 cuts it.
struct CutPlane {
  ScalarGrid grid = testing::sampled({9, 9, 9}, [](const Vec3& p) { return 4.3 - p.x; });
  Isosurface isosurface{grid, 0, {}};
  SearchCounters counters;
  BoxSet room;
  Patch patch{room, 1};
  ShapeSteps steps{patch, isosurface, counters};

  CutPlane(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    room.add(isosurface.box());
    for (const Vec3& p : points) patch.add_vertex(p);
    for (const auto& corners : triangles) patch.add_triangle(corners);
  }
  // The flips at the side across from the last corner of a triangle.
  [[nodiscard]] std::vector<PatchStep> flips_at(std::uint32_t triangle) {
    std::vector<PatchStep> found;
    steps.propose(ShapeStep::kFlip, triangle, 2, 1, found);
    return found;
  }
};

TEST(BoundarySteps, AVertexAHairOffAFaceMovesIntoIt) {
  CutPlane plane({{4.3, 2, 0}, {4.3, 6, 0}, {4.3, 3, 1e-5}, {4.3, 7, 2}, {4.3, 4, 3}, {4.3, 1, 2}},
                 {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 5, 2}, {5, 0, 2}});
  const std::vector<PatchStep> steps = plane.flips_at(0);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].opened, 2U);
  EXPECT_EQ(steps[0].point.z, 0);
  EXPECT_NEAR(steps[0].point.x, 4.3, 1e-9);
  plane.patch.apply(steps[0]);
  VertexLink link;
  ASSERT_TRUE(plane.patch.find_link(2, link));
  EXPECT_FALSE(link.is_closed);
  EXPECT_EQ(link.triangles.size(), 4U);
  for (const std::uint32_t t : link.triangles) EXPECT_GE(plane.patch.quality(t), steps[0].quality);
  EXPECT_GT(steps[0].quality, 0.3);
}

// Vertex 3 lies in the face, two triangles away from the edge of the boundary from 0 to 1: beyond the side at 1, and
// beyond the one at 0.
TEST(BoundarySteps, AnEdgeOfTheBoundaryIsPutBehindAVertexInTheFace) {
  const std::vector<Vec3> points = {{4, 2, 0}, {4, 6, 0}, {4.2, 4, 1}, {5, 4, 0}, {5, 5, 2}};
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  const auto expect_opened = [&](const Triangles& triangles, const std::array<std::uint32_t, 3>& kept) {
    CutPlane plane(points, triangles);
    const std::vector<PatchStep> steps = plane.flips_at(0);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].removed, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(steps[0].added, (Triangles{kept}));
    EXPECT_EQ(steps[0].opened, 3U);
    plane.patch.apply(steps[0]);
    VertexLink link;
    ASSERT_TRUE(plane.patch.find_link(3, link));
    EXPECT_FALSE(link.is_closed);
  };
  expect_opened({{0, 1, 2}, {2, 1, 3}, {1, 4, 3}, {4, 2, 3}}, {0, 3, 2});
  expect_opened({{0, 1, 2}, {0, 2, 3}, {2, 4, 3}, {4, 0, 3}}, {3, 1, 2});
}

// The only triangle at vertex 0 lies in the face z = 0, on an edge of the box or not: it goes. Off that face the
// boundary would leave the box without it.
TEST(BoundarySteps, AnEarInAFaceGoesAtAnEdgeOfTheBoxToo) {
  for (const auto& [tip, count] : {std::pair(Vec3{4.3, 0, 0}, 1U), {Vec3{4.3, 1, 0}, 1U}, {Vec3{4.3, 0, 1}, 0U}}) {
    CutPlane plane({tip, {4.3, 4, 0}, {4.31, 2, 0}, {4.3, 3, 2}}, {{0, 1, 2}, {2, 1, 3}});
    std::vector<PatchStep> found;
    plane.steps.propose(ShapeStep::kRemove, 0, 0, 1, found);
    ASSERT_EQ(found.size(), count) << tip.y << ' ' << tip.z;
    for (const PatchStep& step : found) EXPECT_EQ(step.removed, std::vector<std::uint32_t>{0});
  }
}

}  // namespace
}  // namespace deliso
