#include "surface/recover/component_seeds.h"

#include <gtest/gtest.h>

#include <set>

#include "delaunay/predicates.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;

TEST(ComponentSeeds, EveryComponentHasItsOwnThatLieOnIt) {
  for (const auto& scene : {field_scene("bubbles", 26), field_scene("linked_tori", 32), noise_scene({6, 7, 5}, 1),
                            testing::wave_scene({9, 9, 9}, {1, 0.5, 2}, 1)}) {
    SCOPED_TRACE(scene->name);
    std::vector<std::vector<Vec3>> of(scene->topology.components.size());
    std::vector<std::size_t> crossings(of.size(), 0);
    for (const EdgeCrossing& c : scene->topology.crossings) ++crossings[c.component];
    for (const Vec3& p : component_seeds(scene->surface())) {
      const Vec3& step = scene->isosurface->step();
      const auto c =
          component_of(scene->grid, scene->isovalue, scene->topology, {p.x / step.x, p.y / step.y, p.z / step.z});
      ASSERT_TRUE(c.has_value());
      of[*c].push_back(p);
    }
    for (std::size_t c = 0; c < of.size(); ++c) {
      if (crossings[c] <= kSmallComponent) {
        EXPECT_EQ(of[c].size(), crossings[c]);
      } else {
        EXPECT_EQ(of[c].size(), 14u);
      }
    }
  }
}

// Design decision 3: at least four, and not coplanar, on closed components.
TEST(ComponentSeeds, SeedsOfClosedComponentsSpanSpace) {
  for (const auto& scene : {field_scene("bubbles", 39, 3), field_scene("shells", 32)}) {
    const std::vector<Vec3> seeds = component_seeds(scene->surface());
    std::vector<std::vector<Vec3>> of(scene->topology.components.size());
    for (const Vec3& p : seeds) {
      of[component_of(scene->grid, scene->isovalue, scene->topology, p).value()].push_back(p);
    }
    for (const auto& points : of) {
      bool spans = false;
      for (std::size_t a = 3; a < points.size() && !spans; ++a) {
        for (std::size_t b = 2; b < a && !spans; ++b) {
          for (std::size_t c = 1; c < b && !spans; ++c) {
            spans = orient3d(points[0], points[c], points[b], points[a]) != 0;
          }
        }
      }
      EXPECT_TRUE(spans) << scene->name;
    }
  }
}

TEST(ComponentSeeds, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({34, 33, 35}, 2);
  ASSERT_GT(scene->topology.crossings.size(), std::size_t{50000}) << "too few to be shared";
  const std::vector<Vec3> alone = component_seeds(scene->surface());
  for (const int threads : {2, 3}) {
    EXPECT_EQ(component_seeds(scene->surface(threads)), alone) << threads;
  }
}

TEST(RandomRayPoints, LieOnTheSurfaceInTheBoxAndFollowTheSeed) {
  for (const auto& scene : {field_scene("torus", 16), field_scene("gyroid", 16), noise_scene({5, 5, 5}, 2)}) {
    SCOPED_TRACE(scene->name);
    Rng rng(7);
    Rng same(7);
    Rng other(8);
    SearchCounters counters;
    const auto points = random_ray_points(*scene->isosurface, 200, rng, counters);
    EXPECT_EQ(points.size(), 200u);
    EXPECT_GE(counters.searches, 200u);
    EXPECT_EQ(points, random_ray_points(*scene->isosurface, 200, same, counters));
    EXPECT_NE(points, random_ray_points(*scene->isosurface, 200, other, counters));
    for (const Vec3& p : points) {
      EXPECT_TRUE(scene->isosurface->box().contains(p));
      EXPECT_LE(std::abs(scene->isosurface->value(p)), 1e-8 * (1 + norm(scene->isosurface->gradient(p))));
    }
  }
}

TEST(RandomRayPoints, GiveUpOnASurfaceThatIsHardlyEverHit) {
  // One sample above in the middle of a large volume, barely: a speck.
  std::vector<double> samples(40 * 40 * 40, 0.0);
  samples[20 * 1600 + 20 * 40 + 20] = 1.0;
  const testing::Scene scene("speck", ScalarGrid({40, 40, 40}, samples), 1 - 1e-6);
  Rng rng(1);
  SearchCounters counters;
  EXPECT_TRUE(random_ray_points(*scene.isosurface, 5, rng, counters).empty());
  EXPECT_EQ(component_seeds(scene.surface()).size(), 6u);
}

}  // namespace
}  // namespace deliso
