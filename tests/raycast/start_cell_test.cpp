// The quick search around a line's start must give the hit that a scan of the line gives, or nothing.
#include "raycast/start_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/base/rng.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

struct Query {
  CellCorners corners{};
  Vec3 u;
  Vec3 d;
  [[nodiscard]] double value(double t) const { return trilinear_value(corners, u + t * d); }
};

// Corners between -1 and 1; the line starts up to `farthest` off the surface, as far as the slope can tell.
Query random_query(Rng& rng, double farthest) {
  Query query;
  for (double& corner : query.corners) corner = rng.uniform(-1, 1);
  query.u = {rng.uniform(), rng.uniform(), rng.uniform()};
  query.d = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
  query.d = query.d / norm(query.d);
  const double slope = norm(trilinear_gradient(query.corners, query.u));
  const double lowered = query.value(0) - rng.uniform(-farthest, farthest) * slope;
  for (double& corner : query.corners) corner -= lowered;
  return query;
}

TEST(StartCell, HitsAreWhereTheLineFallsForTheFirstTime) {
  constexpr int kScan = 256;
  Rng rng(3);
  int found = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Query query = random_query(rng, 0.5);
    const auto t = falling_hit_around(query.corners, query.u, query.d);
    if (!t) continue;
    ++found;
    EXPECT_NEAR(query.value(*t), 0, 1e-14) << trial;
    // Above before it, below behind it, and no other change of sign as near to the start.
    for (int i = -kScan; i <= kScan; ++i) {
      const double at = std::abs(*t) * i / kScan;
      const Vec3 p = query.u + at * query.d;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_TRUE(p[axis] > -1e-15 && p[axis] < 1 + 1e-15) << trial;
      }
      if (std::abs(at - *t) > 1e-12) {
        ASSERT_EQ(query.value(at) > 0, at < *t) << trial << " at " << at << " of " << *t;
      }
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(StartCell, HitsNearTheStartAreNotMissed) {
  Rng rng(4);
  int found = 0, falling = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Query query = random_query(rng, 1e-3);
    const Vec3 gradient = trilinear_gradient(query.corners, query.u);
    query.d = gradient / -norm(gradient);  // straight down
    ++falling;
    found += falling_hit_around(query.corners, query.u, query.d) ? 1 : 0;
  }
  EXPECT_GT(found, 0.97 * falling);
}

TEST(StartCell, NothingIsFoundWhereTheLineRisesStandsOrLeavesTheCell) {
  const CellCorners ramp = {-1, 1, -1, 1, -1, 1, -1, 1};  // 2 u - 1
  EXPECT_TRUE(falling_hit_around(ramp, {0.4, 0.5, 0.5}, {-1, 0, 0}).has_value());
  EXPECT_FALSE(falling_hit_around(ramp, {0.4, 0.5, 0.5}, {1, 0, 0}).has_value());
  EXPECT_FALSE(falling_hit_around(ramp, {0.4, 0.5, 0.5}, {0, 1, 0}).has_value());
  EXPECT_FALSE(falling_hit_around(ramp, {0.4, 0.5, 0.5}, {0, 0, 0}).has_value());
  // The hit lies in the cell, but a point as far to the other side does not.
  EXPECT_FALSE(falling_hit_around(ramp, {0.9, 0.5, 0.5}, {-1, 0, 0}).has_value());
  // A flat cell, one without the isovalue, and values that are no numbers.
  EXPECT_FALSE(falling_hit_around({}, {0.5, 0.5, 0.5}, {-1, 0, 0}).has_value());
  EXPECT_FALSE(falling_hit_around({9, 8, 9, 8, 9, 8, 9, 8}, {0.5, 0.5, 0.5}, {1, 0, 0}).has_value());
  const double nan = std::nan("");
  EXPECT_FALSE(falling_hit_around({nan, 1, 1, 1, 1, 1, 1, -1}, {0.5, 0.5, 0.5}, {1, 0, 0}).has_value());
}

}  // namespace
}  // namespace deliso
