// Data of the surface: computed in advance or on request, on any number of threads.
#include "surface/repair/diagnosis/exact_surface_cache.h"

#include <gtest/gtest.h>

#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;

TEST(ExactSurfaceCache, AreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({14, 13, 12}, 4);
  const ExactPolygonization surface = exact_polygonization(scene->surface());
  const ExactEulerCurves curves(scene->surface());
  for (const int threads : {1, 2, 3, 5}) {
    const ExactSurfaceCache cache(scene->surface(threads));
    EXPECT_EQ(cache.polygonized().mesh.points, surface.mesh.points) << threads;
    EXPECT_EQ(cache.polygonized().mesh.triangles, surface.mesh.triangles) << threads;
    EXPECT_EQ(cache.polygonized().component, surface.component) << threads;
    for (std::uint32_t c = 0; c < scene->topology.components.size(); ++c) {
      EXPECT_EQ(cache.euler_curves().of(c), curves.of(c)) << threads;
    }
  }
}

TEST(ExactSurfaceCache, IsDestroyedWithoutRequests) {
  const auto scene = field_scene("gyroid", 32);
  for (int i = 0; i < 20; ++i) ExactSurfaceCache(scene->surface(2));
}

}  // namespace
}  // namespace deliso
