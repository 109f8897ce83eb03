// The search of a ball against points drawn in it.
#include "surface/certificate/other_side.h"

#include <gtest/gtest.h>

#include <cmath>

#include "delaunay/base/rng.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

Vec3 drawn_in_ball(Rng& rng, const Vec3& center, double reach) {
  Vec3 offset;
  do {
    for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = 2 * rng.uniform() - 1;
  } while (squared_norm(offset) > 1);
  return center + reach * offset;
}

bool is_other_side_drawn(Rng& rng, const Isosurface& isosurface, const Vec3& p, double reach, int points) {
  const bool is_above = isosurface.is_above(p);
  for (int i = 0; i < points; ++i) {
    const Vec3 q = drawn_in_ball(rng, p, reach);
    if (isosurface.box().contains(q) && isosurface.is_above(q) != is_above) return true;
  }
  return false;
}

TEST(OtherSide, IsFoundWhereDrawnPointsLieOnIt) {
  Rng rng(5);
  int found = 0, open = 0, all = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 16), testing::noise_scene({9, 8, 10}, 3)}) {
    const Isosurface& isosurface = *scene->isosurface;
    for (int i = 0; i < 600; ++i) {
      Vec3 p;
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = rng.uniform() * isosurface.box().high[axis];
      const double reach = std::pow(10, -2.5 * rng.uniform()) * 2;
      const bool is_found = other_side_within(isosurface, p, reach).has_value();
      // Drawn within a little less, whatever is drawn has to be found; of what is found, all but slivers are drawn.
      if (is_other_side_drawn(rng, isosurface, p, 0.998 * reach, 300)) {
        EXPECT_TRUE(is_found) << i;
      } else if (is_found) {
        open += is_other_side_drawn(rng, isosurface, p, 1.002 * reach, 20'000) ? 0 : 1;
      }
      found += is_found ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(found, all / 5);
  EXPECT_LT(found, all * 4 / 5);
  EXPECT_LE(open, all / 200);
}

}  // namespace
}  // namespace deliso
