#include "raycast/empty_bricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "raycast/isosurface.h"
#include "tests/support/raycast_fields.h"

namespace deliso {
namespace {

using testing::describe;
using testing::noise_grid;
using testing::random_line;
using testing::sampled_grid;

// A few active cells in much empty space: a small ball, a slanted plane near a corner, noise on one side of an else
// constant volume. Sizes on both sides of multiples of the brick's.
std::vector<ScalarGrid> sparse_grids() {
  std::vector<ScalarGrid> grids;
  for (const Dims& dims : {Dims{33, 40, 51}, Dims{64, 63, 3}, Dims{16, 32, 20}, Dims{2, 5, 70}}) {
    const auto ball = [&](double i, double j, double k) {
      return 2.3 - norm(Vec3{i - 0.3 * dims[0], j - 0.6 * dims[1], k - 0.7 * dims[2]});
    };
    const auto plane = [](double i, double j, double k) { return i + 1.3 * j + 0.9 * k - 7.1; };
    Rng rng(3);
    const auto noise = [&](int i, int, int) { return i < 3 ? rng.uniform(-1, 1) : 1.0; };
    grids.push_back(sampled_grid<float>(dims, {1, 1, 1}, ball));
    grids.push_back(sampled_grid<float>(dims, {1, 1.5, 2}, plane));
    grids.push_back(sampled_grid<double>(dims, {0.7, 1, 1}, noise));
  }
  return grids;
}

constexpr double kIsovalue = 0.01;

std::int32_t brick_distance(const Cell& a, const Cell& b) {
  std::int32_t apart = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) apart = std::max(apart, std::abs(a[axis] / 4 - b[axis] / 4));
  return apart;
}

template <class Visit>
void for_every_cell(const Dims& dims, Visit visit) {
  for (std::int32_t z = 0; z <= dims[2]; ++z)
    for (std::int32_t y = 0; y <= dims[1]; ++y)
      for (std::int32_t x = 0; x <= dims[0]; ++x) visit(Cell{x, y, z});
}

Cell random_cell(const Dims& dims, Rng& rng) {
  const auto coordinate = [&](std::size_t a) {
    return static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(dims[a]) + 1));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

TEST(EmptyBricks, ClearanceIsTheDistanceToTheNearestActiveBrick) {
  for (const ScalarGrid& grid : sparse_grids()) {
    const ActiveCells active(grid, kIsovalue);
    const EmptyBricks bricks(grid, active, kIsovalue);
    std::vector<Cell> active_cells;
    for_every_cell(grid.dims(), [&](const Cell& cell) {
      if (active.is_active(cell)) active_cells.push_back(cell);
    });
    ASSERT_FALSE(active_cells.empty());
    Rng rng(4);
    for (int trial = 0; trial < 300; ++trial) {
      const Cell cell = random_cell(grid.dims(), rng);
      std::int32_t nearest = EmptyBricks::kFarthest;
      for (const Cell& other : active_cells) nearest = std::min(nearest, brick_distance(cell, other));
      ASSERT_EQ(std::abs(bricks.clearance(cell)), nearest) << cell[0] << " " << cell[1] << " " << cell[2];
    }
    const EmptyBricks of_three_threads(grid, active, kIsovalue, 3);
    for_every_cell(grid.dims(), [&](const Cell& cell) {
      ASSERT_EQ(of_three_threads.clearance(cell), bricks.clearance(cell))
          << cell[0] << " " << cell[1] << " " << cell[2];
    });
  }
}

TEST(ActiveCells, AreThoseWhoseCornersDifferForAnyNumberOfThreads) {
  Rng rng(5);
  const ScalarGrid grid = noise_grid({9, 66, 67}, {1, 1, 1}, rng);
  const Dims& dims = grid.dims();
  // Values close to one side, so that not all cells are active.
  const double isovalue = grid.range().second - 0.05 * (grid.range().second - grid.range().first);
  for (const int threads : {1, 2, 5}) {
    const ActiveCells active(grid, isovalue, threads);
    for_every_cell(dims, [&](const Cell& cell) {
      int above = 0, below = 0;
      for (unsigned corner = 0; corner < 8; ++corner) {
        // Extended cell e has samples e - 1 and e, as far as there are any.
        const auto sample = [&](std::size_t axis) {
          return std::clamp(cell[axis] - 1 + static_cast<std::int32_t>(corner >> axis & 1u), 0, dims[axis] - 1);
        };
        ++(grid.at(sample(0), sample(1), sample(2)) > isovalue ? above : below);
      }
      ASSERT_EQ(active.is_active(cell), above > 0 && below > 0) << cell[0] << " " << cell[1] << " " << cell[2];
    });
  }
}

TEST(EmptyBricks, AnyActiveIsALookAtEveryCellOfTheBox) {
  Rng rng(5);
  std::vector<ScalarGrid> grids = sparse_grids();
  grids.push_back(noise_grid({11, 8, 9}, {1, 1, 1}, rng));
  int found = 0;
  int trials = 0;
  for (const ScalarGrid& grid : grids) {
    const ActiveCells active(grid, kIsovalue);
    for (int trial = 0; trial < 200; ++trial, ++trials) {
      const Cell a = random_cell(grid.dims(), rng);
      Cell low;
      Cell high;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = a[axis];
        high[axis] = std::min(a[axis] + static_cast<std::int32_t>(rng.below(10)), grid.dims()[axis]);
      }
      bool expected = false;
      for (Cell c = low; c[2] <= high[2]; ++c[2])
        for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
          for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) expected |= active.is_active(c);
      ASSERT_EQ(active.any_active(low, high), expected);
      found += expected ? 1 : 0;
    }
  }
  EXPECT_GT(found, trials / 20);
  EXPECT_LT(found, trials - trials / 20);
}

TEST(EmptyBricks, TellTheSideOfEveryPointAsValuesDo) {
  int quick = 0;
  for (const ScalarGrid& grid : sparse_grids()) {
    const Isosurface surface(grid, kIsovalue, {});
    Rng rng(6);
    for (int trial = 0; trial < 3000; ++trial) {
      Vec3 p = random_line(surface, rng).origin;
      if (rng.below(8) == 0) p = 1e7 * p;
      quick += surface.place_of(p).clearance != 0 ? 1 : 0;
      ASSERT_EQ(surface.is_above(p), surface.value(p) >= 0) << p.x << " " << p.y << " " << p.z;
    }
  }
  EXPECT_GT(quick, 1000);
}

TEST(EmptyBricks, SegmentsCalledClearHaveNoHit) {
  SearchOptions no_pruning;
  no_pruning.min_max_pruning = false;
  int clear = 0;
  int missed = 0;
  for (const ScalarGrid& grid : sparse_grids()) {
    const Isosurface surface(grid, kIsovalue, {});
    const Isosurface plain(grid, kIsovalue, no_pruning);
    Rng rng(7);
    for (int trial = 0; trial < 3000; ++trial) {
      const Line line = random_line(surface, rng);
      const double end = rng.uniform(0, rng.below(2) == 0 ? 5 : 40);
      std::vector<Hit> hits;
      SearchCounters counters;
      plain.all_hits(line, 0, end, hits, counters);
      const Vec3 b = line.at(end);
      const auto place_a = surface.place_of(line.origin);
      const auto place_b = surface.place_of(b);
      const bool is_clear = surface.is_clear(line.origin, place_a, b, place_b);
      ASSERT_TRUE(!is_clear || hits.empty()) << describe(line, 0, end);
      ASSERT_TRUE(!surface.is_clear_box(place_a, place_b) || is_clear) << describe(line, 0, end);
      ASSERT_FALSE(plain.is_clear(line.origin, plain.place_of(line.origin), b, plain.place_of(b)));
      clear += is_clear ? 1 : 0;
      missed += !is_clear && hits.empty() ? 1 : 0;
    }
  }
  // Most segments without a hit are recognised.
  EXPECT_GT(clear, missed);
}

// Rays that begin or end far from the isosurface are cut there: the hits are those of the whole walk, bit for bit.
TEST(EmptyBricks, RaysThroughEmptySpaceHaveTheSameHits) {
  SearchOptions no_pruning;
  no_pruning.min_max_pruning = false;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  for (const ScalarGrid& grid : sparse_grids()) {
    const Isosurface surface(grid, kIsovalue, {});
    const Isosurface plain(grid, kIsovalue, no_pruning);
    Rng rng(8);
    for (int trial = 0; trial < 4000; ++trial) {
      Line line = random_line(surface, rng);
      // Along an axis, or nearly; on a plane of the grid, or nearly.
      const std::size_t axis = rng.below(3);
      if (rng.below(4) == 0) line.direction[axis] *= rng.below(2) == 0 ? 0 : 1e-17;
      if (rng.below(4) == 0) line.origin[axis] = std::nextafter(std::round(line.origin[axis]), rng.uniform(-100, 100));
      const double t0 = rng.below(4) == 0 ? -kInfinity : rng.uniform(-80, 20);
      const double t1 = rng.below(4) == 0 ? kInfinity : rng.uniform(std::max(t0, -80.0), 100);
      std::vector<Hit> hits, expected;
      SearchCounters counters, expected_counters;
      surface.all_hits(line, t0, t1, hits, counters);
      plain.all_hits(line, t0, t1, expected, expected_counters);
      ASSERT_EQ(hits.size(), expected.size()) << describe(line, t0, t1);
      for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i].t, expected[i].t) << describe(line, t0, t1);
      found += hits.size();
    }
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace deliso
