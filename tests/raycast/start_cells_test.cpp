// The quick search around a line's start must give the hit that a scan of the line gives, or nothing.
#include "raycast/start_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "delaunay/base/box3.h"
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

void put_in_lane(const Query& query, std::size_t lane, StartCells& cells) {
  for (std::size_t corner = 0; corner < 8; ++corner) cells.relative[corner][lane] = query.corners[corner];
  cells.line.set(lane, {query.u, query.d});
  cells.reach[lane] = 10;
}

// In a lane that changes from call to call, beside cells without a hit; and in the first one alone, to the same bits.
std::optional<double> falling_hit_around(const CellCorners& corners, const Vec3& u, const Vec3& d) {
  static std::size_t calls = 0;
  const std::size_t lane = calls++ % kLanes;
  StartCells cells;
  put_in_lane({corners, u, d}, lane, cells);
  falling_hits_around(false, cells);
  for (std::size_t other = 0; other < kLanes; ++other) {
    EXPECT_TRUE(other == lane || std::isnan(cells.hit[other]));
  }
  StartCells alone;
  put_in_lane({corners, u, d}, 0, alone);
  falling_hits_around(true, alone);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(alone.hit[0]), std::bit_cast<std::uint64_t>(cells.hit[lane]));
  return std::isnan(cells.hit[lane]) ? std::nullopt : std::optional(cells.hit[lane]);
}

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

TEST(StartCells, HitsAreWhereTheLineFallsForTheFirstTime) {
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

TEST(StartCells, HitsNearTheStartAreNotMissed) {
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

TEST(StartCells, NothingIsFoundWhereTheLineRisesStandsOrLeavesTheCell) {
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

// Along the main diagonal of a cell whose corners depend on their number of ones alone, the interpolant is the cubic
// with these Bernstein coefficients: so its roots are known.
CellCorners corners_with_roots_on_diagonal(double r0, double r1, double r2, double scale) {
  const std::array<double, 3> r = {r0, r1, r2};
  const auto blossom = [&](std::size_t ones) {
    double sum = 0;
    for (const auto& o : {std::array{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
      double product = 1;
      for (std::size_t i = 0; i < 3; ++i) product *= (i < ones ? 1 : 0) - r[static_cast<std::size_t>(o[i])];
      sum += product;
    }
    return scale * sum / 6;
  };
  CellCorners corners;
  for (std::size_t c = 0; c < 8; ++c) corners[c] = blossom((c & 1) + (c >> 1 & 1) + (c >> 2));
  return corners;
}

TEST(StartCells, HitsOfBentCubicsAreTheNearestFallingRoots) {
  Rng rng(7);
  int found = 0, tempting = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    std::array<double, 3> roots;
    for (double& root : roots) root = rng.uniform();
    std::sort(roots.begin(), roots.end());
    if (roots[1] - roots[0] < 1e-2 || roots[2] - roots[1] < 1e-2) continue;
    const double scale = rng.below(2) == 0 ? 1 : -1, start = rng.uniform(0.2, 0.8);
    const CellCorners corners = corners_with_roots_on_diagonal(roots[0], roots[1], roots[2], scale);
    double nearest = 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool falls = (i == 1) == (scale > 0);
      if (falls && std::abs(roots[i] - start) < std::abs(nearest)) nearest = roots[i] - start;
    }
    ++tempting;
    const auto t = falling_hit_around(corners, {start, start, start}, {1, 1, 1});
    if (!t) continue;
    ++found;
    ASSERT_NEAR(*t, nearest, 1e-10) << trial;
  }
  EXPECT_GT(found, tempting / 20);
}

TEST(StartCells, HitsBeyondTheReachAreNone) {
  StartCells cells;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    put_in_lane({{-1, 1, -1, 1, -1, 1, -1, 1}, {0.7, 0.5, 0.5}, {-1, 0, 0}}, lane, cells);  // 2 u - 1: a hit at 0.2
    cells.reach[lane] = lane == 0 ? 0.19 : lane == 1 ? 0.21 : lane == 2 ? -1 : 10;
  }
  falling_hits_around(false, cells);
  EXPECT_TRUE(std::isnan(cells.hit[0]));
  EXPECT_NEAR(cells.hit[1], 0.2, 1e-15);
  EXPECT_TRUE(std::isnan(cells.hit[2]));
  EXPECT_NEAR(cells.hit[3], 0.2, 1e-15);
}

TEST(StartCells, LanesDoNotKnowOfEachOther) {
  Rng rng(5);
  for (int trial = 0; trial < 2000; ++trial) {
    StartCells cells;
    std::array<Query, kLanes> queries;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      queries[lane] = random_query(rng, 0.1);
      put_in_lane(queries[lane], lane, cells);
    }
    falling_hits_around(false, cells);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto alone = falling_hit_around(queries[lane].corners, queries[lane].u, queries[lane].d);
      ASSERT_EQ(std::isnan(cells.hit[lane]), !alone.has_value()) << trial;
      if (alone) {
        ASSERT_EQ(cells.hit[lane], *alone) << trial;
      }
    }
  }
}

TEST(StartCells, LinesStartInTheCellOfTheirOrigin) {
  Rng rng(6);
  const Dims dims = {5, 9, 17};
  const Vec3 inverse_step{1, 0.5, 0.25};
  for (int trial = 0; trial < 2000; ++trial) {
    LineLanes lines;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // At times on a sample, at times beyond the box.
      Vec3 origin{rng.uniform(-1, 5), rng.uniform(-2, 18), rng.uniform(-4, 70)};
      if (trial % 3 == 0) origin = {std::round(origin.x), 2 * std::round(origin.y / 2), 4 * std::round(origin.z / 4)};
      lines.set(lane, {origin, {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}});
    }
    StartCells cells;
    const Vec3 high{4, 16, 64};
    find_start_cells(lines, 3, {dims, inverse_step, high}, false, cells);
    StartCells alone;
    find_start_cells(lines, 3, {dims, inverse_step, high}, true, alone);
    ASSERT_TRUE(alone.first[0] == cells.first[0] && alone.reach[0] == cells.reach[0]);
    ASSERT_TRUE(alone.line.origin.at(0) == cells.line.origin.at(0));
    ASSERT_TRUE(alone.line.direction.at(0) == cells.line.direction.at(0));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 place = cells.line.origin.at(lane), at = scaled(lines.origin.at(lane), inverse_step);
      std::size_t index = cells.first[lane];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto count = static_cast<std::size_t>(dims[axis]);
        const auto cell = static_cast<double>(index % count);
        index /= count;
        ASSERT_LT(cell, static_cast<double>(count - 1));
        const double inside = std::clamp(at[axis], 0.0, static_cast<double>(count - 1));
        ASSERT_EQ(cell + place[axis], inside) << trial << " axis " << axis;
        ASSERT_TRUE(place[axis] >= 0 && place[axis] <= 1);
        ASSERT_EQ(cells.line.direction.at(lane)[axis], lines.direction.at(lane)[axis] * inverse_step[axis]);
      }
      ASSERT_EQ(index, 0u);
      ASSERT_EQ(cells.reach[lane], Box3({{0, 0, 0}, high}).contains(lines.origin.at(lane)) ? 3 : -1) << trial;
    }
  }
}

}  // namespace
}  // namespace deliso
