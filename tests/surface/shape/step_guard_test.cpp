// Which steps of the shape stage are refused.
#include "surface/shape/step_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/triangle_contact.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

constexpr std::uint32_t kSide = 7;  // vertices along each side of the patch

// A layer of zeros between high values: a wall 0.004 voxels thick, and a patch of its lower side.
struct ThinWall {
  ScalarGrid grid = testing::sampled({9, 9, 9}, [](const Vec3& p) { return p.z == 4 ? 0.0 : 255.0; });
  Isosurface isosurface{grid, 0.5, {}};
  double height = 4 - 0.5 / 255;
  SearchCounters counters;
  BoxSet room;
  Patch patch{room, 1};

  ThinWall() {
    room.add(isosurface.box());
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      patch.add_vertex({1.25 + i % kSide, 1.25 + static_cast<double>(i / kSide), height});
    }
    for (std::uint32_t i = 0; i + kSide < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1) continue;
      patch.add_triangle({i, i + 1, i + kSide});
      patch.add_triangle({i + 1, i + kSide + 1, i + kSide});
    }
  }

  // The vertex in the middle at another place.
  [[nodiscard]] PatchStep move_to(const Vec3& place) const {
    constexpr std::uint32_t kMiddle = kSide * kSide / 2;
    VertexLink link;
    EXPECT_TRUE(patch.find_link(kMiddle, link));
    PatchStep step{ShapeStep::kMove, link.triangles, {}, kMiddle, place, 0, patch.point(kMiddle)};
    for (std::size_t i = 0; i < link.vertices.size(); ++i) {
      step.added.push_back({kMiddle, link.vertices[i], link.vertices[(i + 1) % link.vertices.size()]});
    }
    return step;
  }
};

// A rounding beside their plane such triangles do not meet, by exact tests, and the other side of the wall is near.
TEST(StepGuard, TrianglesAreNotFoldedOntoOthersInThinWalls) {
  ThinWall wall;
  ShapeOptions options;
  options.max_height = 0.5;
  StepGuard guard(wall.patch, {}, wall.isosurface, options, wall.counters);
  guard.set_freedom(16);
  Rng rng(3);
  int accepted = 0;
  for (int n = 0; n < 3000; ++n) {
    const double z = wall.height + std::ldexp(static_cast<double>(rng.below(3)) - 1, -50);
    const std::size_t first = wall.patch.triangle_count();
    const Vec3 place = {4.25 + 3 * (rng.uniform() - 0.5), 4.25 + 3 * (rng.uniform() - 0.5), z};
    if (!guard.apply(wall.move_to(place))) continue;
    ++accepted;
    for (auto t = static_cast<std::uint32_t>(first); t < wall.patch.triangle_count(); ++t) {
      const auto [a, b, c] = wall.patch.corner_points(t);
      EXPECT_GT(cross(b - a, c - a).z, 0) << n;
    }
    wall.patch.undo();
  }
  EXPECT_GT(accepted, 500);
}

TEST(StepGuard, TrianglesMeetThoseWhoseSineRoundsToZero) {
  ThinWall wall;
  Patch patch(1);
  for (const Vec3& p : {Vec3{0, 0, 4}, Vec3{3, 0, 4}, Vec3{1, 3, 4}}) patch.add_vertex(p);
  const Vec3 a{1, 0.5, 3.5}, b = a + Vec3{0, 1 + 0x1p-30, 1}, c = a + Vec3{0, 1 + 0x1p-29, 1 + 0x1p-30};
  for (const Vec3& p : {a, b, c}) patch.add_vertex(p);
  patch.add_triangle({0, 1, 2});
  patch.add_triangle({3, 4, 5});
  ASSERT_EQ(patch.quality(1), 0);
  ASSERT_TRUE(has_area(a, b, c));
  StepGuard guard(patch, {}, wall.isosurface, {}, wall.counters);
  std::vector<std::uint32_t> found;
  guard.append_meeting(0, found);
  EXPECT_EQ(found, std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace deliso
