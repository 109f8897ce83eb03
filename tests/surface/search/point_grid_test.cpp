#include "surface/search/point_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(PointGrid, TellOfEveryPointInABoxAndOfNoneFarFromIt) {
  Rng rng(3);
  const auto random = [&](const Vec3& sides) {
    return Vec3{sides.x * (rng.uniform() - 0.3), sides.y * (rng.uniform() - 0.3), sides.z * (rng.uniform() - 0.3)};
  };
  int found = 0, beside = 0;
  // A cube, a rod, a sheet that is very long, and a single place.
  for (const Vec3& sides : {Vec3{20, 20, 20}, Vec3{50, 1, 1}, Vec3{3000, 700, 0}, Vec3{0, 0, 0}}) {
    std::vector<Vec3> points(300);
    for (Vec3& p : points) p = random(sides);
    const double side = 2, longest = std::max({side, sides.x / 128});
    const PointGrid blocks(points, side);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      int own = 0;
      blocks.for_each_beside(points[i], [&](std::uint32_t j) { own += i == j ? 1 : 0; });
      EXPECT_EQ(own, 1);
    }
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 low = random(1.5 * sides + Vec3{2, 2, 2}), size = 0.1 * random(sides) + Vec3{2, 2, 2};
      const Box3 box{low, low + size};
      blocks.for_each_beside(low, [&](std::uint32_t i) {
        const Vec3 d = points[i] - low;
        EXPECT_LE(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), 1.01 * longest);
        ++beside;
      });
      std::vector<int> visits(points.size(), 0);
      blocks.for_each_near(box, [&](std::uint32_t i) { ++visits[i]; });
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(visits[i], 1);
        const Vec3 around{1.01 * longest, 1.01 * longest, 1.01 * longest};
        EXPECT_TRUE(visits[i] == 1 || !box.contains(points[i]));
        EXPECT_TRUE(visits[i] == 0 || (Box3{box.low - around, box.high + around}).contains(points[i]));
        found += visits[i];
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(beside, 1000);
  PointGrid({}, 2).for_each_near({{0, 0, 0}, {1, 1, 1}}, [](std::uint32_t) { FAIL(); });
  PointGrid({}, 2).for_each_beside({0, 0, 0}, [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace deliso
