// Triangles in necks and at edges where the isosurface nowhere faces as they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/shape/best_filling.h"
#include "surface/shape/patch.h"
#include "surface/shape/shape_steps.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

// No step was taken there, whatever stood before it: the smallest angles were 0.13 to 3.97 degrees.
TEST(Necks, TrianglesThatNothingFacesAreReplacedByBetterOnes) {
  for (const std::uint64_t seed : {9U, 43U, 61U, 115U, 125U, 127U}) {
    Rng rng(seed);
    const ScalarGrid grid = testing::sampled({9, 9, 9}, [&](const Vec3&) { return std::floor(256 * rng.uniform()); });
    const MeshingResult result = mesh_isosurface(grid, 127.5, {});
    EXPECT_TRUE(is_proven(result.certificate)) << seed;
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven) << seed;
    EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 8) << seed;
  }
}

// A tube whose waist is the triangle 0, 1, 2, wider above (3, 4, 5) and below (6, 7, 8).
struct NarrowWaist {
  ScalarGrid grid = testing::sampled({9, 9, 9}, [](const Vec3& p) { return 4.3 - p.x; });
  Isosurface isosurface{grid, 0, {}};
  SearchCounters counters;
  BoxSet room;
  Patch patch{room, 1};
  ShapeSteps steps{patch, isosurface, counters};

  NarrowWaist() {
    room.add(isosurface.box());
    for (const auto& [radius, height] : {std::pair{1.0, 4.0}, {1.5, 5.5}, {1.5, 2.5}}) {
      for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3;
        patch.add_vertex({4 + radius * std::cos(angle), 4 + radius * std::sin(angle), height});
      }
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t next = (i + 1) % 3;
      patch.add_triangle({i, next, 3 + next});
      patch.add_triangle({i, 3 + next, 3 + i});
      patch.add_triangle({next, i, 6 + next});
      patch.add_triangle({i, 6 + i, 6 + next});
    }
  }
};

// The best of all fillings has a second edge from 1 to 2, which would not be a manifold.
TEST(Necks, VerticesOfWaistsOfThreeEdgesCanBeRemoved) {
  NarrowWaist waist;
  VertexLink link;
  ASSERT_TRUE(waist.patch.find_link(0, link));
  std::vector<Vec3> polygon;
  for (const std::uint32_t v : link.vertices) polygon.push_back(waist.patch.point(v));
  const auto joins_waist = [](const std::array<std::uint32_t, 3>& t) {
    return std::count_if(t.begin(), t.end(), [](std::uint32_t v) { return v == 1 || v == 2; }) == 2;
  };
  const std::vector<std::array<std::size_t, 3>> best = BestFilling(polygon).triangles();
  EXPECT_TRUE(std::any_of(best.begin(), best.end(), [&](const auto& t) {
    return joins_waist({link.vertices[t[0]], link.vertices[t[1]], link.vertices[t[2]]});
  }));
  std::vector<PatchStep> found;
  waist.steps.propose(ShapeStep::kRemove, 0, 0, 1, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].quality, 0);
  EXPECT_EQ(found[0].added.size(), 4u);
  EXPECT_TRUE(std::none_of(found[0].added.begin(), found[0].added.end(), joins_waist));
}

}  // namespace
}  // namespace deliso
