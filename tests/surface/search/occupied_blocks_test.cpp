#include "surface/search/occupied_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(OccupiedBlocks, WhatIsNearNoneIsFarFromAllPoints) {
  Rng rng(7);
  const auto random = [&](const Vec3& sides) {
    return Vec3{sides.x * (rng.uniform() - 0.3), sides.y * (rng.uniform() - 0.3), sides.z * (rng.uniform() - 0.3)};
  };
  int far = 0, near = 0;
  // A cube, a rod, a sheet so long that its blocks grow, and a single place.
  for (const Vec3& sides : {Vec3{40, 40, 40}, Vec3{50, 1, 1}, Vec3{3000, 700, 0}, Vec3{0, 0, 0}}) {
    std::vector<Vec3> points(20);
    for (Vec3& p : points) p = random(sides);
    const OccupiedBlocks blocks(points, 3);
    EXPECT_GE(blocks.reach(), 2.99);
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 p = random(2 * sides + Vec3{30, 30, 30});
      double nearest = 1e300;  // along the axis along which it is farthest
      for (const Vec3& q : points) {
        const Vec3 d = p - q;
        nearest = std::min(nearest, std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
      }
      EXPECT_TRUE(blocks.is_near(p) || nearest > blocks.reach());
      (blocks.is_near(p) ? near : far) += 1;
    }
    EXPECT_FALSE(blocks.is_near({1e300, -1e300, 1e300}));  // no place is too far off to ask
  }
  EXPECT_GT(far, 2000);
  EXPECT_GT(near, 500);
}

}  // namespace
}  // namespace deliso
