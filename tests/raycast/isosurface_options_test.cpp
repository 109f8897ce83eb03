// Options of the search: they never change the hits; and what they change in the counters.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "tests/support/raycast_cases.h"
#include "tests/support/raycast_fields.h"
#include "tests/support/raycast_oracle.h"

namespace deliso {
namespace {

using testing::Case;
using testing::cases;
using testing::describe;
using testing::hits_of;
using testing::noise_grid;
using testing::random_line;
using testing::RayOracle;
using testing::wave_grid;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

std::vector<SearchOptions> all_options() {
  std::vector<SearchOptions> list;
  for (const Traversal traversal : {Traversal::kKdTree, Traversal::kCellWalk})
    for (const bool pruning : {true, false})
      for (const std::int32_t leaf : {1, 5, 64})
        for (const bool incremental : {true, false}) {
          SearchOptions options;
          options.traversal = traversal;
          options.min_max_pruning = pruning;
          options.leaf_cells = leaf;
          options.incremental = incremental;
          list.push_back(options);
        }
  return list;
}

TEST(Isosurface, EveryTraversalFindsTheSameHitsBitForBit) {
  for (const Case& c : cases()) {
    const Isosurface reference(c.grid, c.isovalue, {});
    for (const SearchOptions& options : all_options()) {
      const Isosurface surface(c.grid, c.isovalue, options);
      Rng rng(16);
      for (int trial = 0; trial < 300; ++trial) {
        const Line line = random_line(surface, rng);
        const bool infinite = rng.below(4) == 0;
        const double t0 = infinite ? -kUnbounded : rng.uniform(-20, 20);
        const double t1 = infinite ? kUnbounded : rng.uniform(t0, 40);
        const std::vector<Hit> expected = hits_of(reference, line, t0, t1);
        const std::vector<Hit> hits = hits_of(surface, line, t0, t1);
        ASSERT_EQ(hits.size(), expected.size()) << describe(line, t0, t1);
        for (std::size_t i = 0; i < hits.size(); ++i) {
          ASSERT_EQ(hits[i].t, expected[i].t) << describe(line, t0, t1);
          ASSERT_EQ(hits[i].falling, expected[i].falling) << describe(line, t0, t1);
        }
      }
    }
  }
}

std::optional<double> nearest_of_all_hits(const Isosurface& surface, const Line& line, double reach) {
  std::optional<double> nearest;
  for (const Hit& hit : hits_of(surface, line, -kUnbounded, kUnbounded))
    if (hit.falling && std::abs(hit.t) <= reach && (!nearest || std::abs(hit.t) <= std::abs(*nearest))) nearest = hit.t;
  return nearest;
}

// Section 4.2 against the whole line: bit for bit by the walks outward. A hit that is found in the start cell without
// them differs by rounding (another cubic, of the cell's own parameter, and another iteration), but by no option; it
// counts as one solve, so several solves tell of the walks.
TEST(Isosurface, NearestFallingHitIsTheNearestOfAllHitsWithEveryOption) {
  for (const CubicSolver solver : {CubicSolver::kBracketed, CubicSolver::kSchwarze}) {
    SearchOptions plain;
    plain.solver = solver;
    for (const Case& c : cases()) {
      const Isosurface reference(c.grid, c.isovalue, plain);
      for (SearchOptions options : all_options()) {
        options.solver = solver;
        const bool is_quick = options.incremental && solver == CubicSolver::kBracketed;
        const Isosurface surface(c.grid, c.isovalue, options);
        Rng rng(17);
        for (int trial = 0; trial < 300; ++trial) {
          const Line line = random_line(surface, rng);
          const double reach = rng.below(2) == 0 ? kUnbounded : rng.uniform(0, 5);
          const std::optional<double> expected = nearest_of_all_hits(reference, line, reach);
          SearchCounters counters;
          const std::optional<double> found = surface.nearest_falling_hit(line, reach, counters);
          ASSERT_EQ(found.has_value(), expected.has_value()) << describe(line, -reach, reach);
          if (!found) continue;
          if (is_quick) {
            ASSERT_NEAR(*found, *expected, 1e-12) << describe(line, -reach, reach);
            SearchCounters other;
            ASSERT_EQ(*found, *reference.nearest_falling_hit(line, reach, other)) << describe(line, -reach, reach);
          }
          if (!is_quick || counters.solves > 1) {
            ASSERT_EQ(*found, *expected) << describe(line, -reach, reach);
          }
        }
      }
    }
  }
}

TEST(Isosurface, SearchesSideBySideFindWhatEachFindsAlone) {
  for (const CubicSolver solver : {CubicSolver::kBracketed, CubicSolver::kSchwarze}) {
    for (const Case& c : cases()) {
      for (SearchOptions options : all_options()) {
        options.solver = solver;
        const Isosurface surface(c.grid, c.isovalue, options);
        Rng rng(23);
        for (int trial = 0; trial < 16; ++trial) {
          LineLanes lines;
          std::array<bool, kLanes> asked;
          for (std::size_t i = 0; i < kLanes; ++i) {
            lines.set(i, random_line(surface, rng));
            asked[i] = rng.uniform() < 0.7;
          }
          Lanes hits;
          SearchCounters together, alone;
          surface.nearest_falling_hits(lines, asked, 5, hits, together);
          for (std::size_t i = 0; i < kLanes; ++i) {
            if (!asked[i]) continue;
            const std::optional<double> hit = surface.nearest_falling_hit(lines.at(i), 5, alone);
            ASSERT_EQ(std::isnan(hits[i]), !hit.has_value()) << describe(lines.at(i), -5, 5);
            if (hit) {
              ASSERT_EQ(hits[i], *hit) << describe(lines.at(i), -5, 5);
            }
          }
          EXPECT_EQ(together.searches, alone.searches);
          EXPECT_EQ(together.solves, alone.solves);
          EXPECT_EQ(together.searches_hit, alone.searches_hit);
          EXPECT_EQ(together.solves_hit, alone.solves_hit);
        }
      }
    }
  }
}

TEST(Isosurface, SchwarzeFindsTheSameHitsExceptNearTouches) {
  for (const Case& c : cases()) {
    SearchOptions options;
    options.solver = CubicSolver::kSchwarze;
    const Isosurface schwarze(c.grid, c.isovalue, options);
    const Isosurface bracketed(c.grid, c.isovalue, {});
    const RayOracle oracle(c.grid, c.isovalue, schwarze.step());
    Rng rng(18);
    for (int trial = 0; trial < 1000; ++trial) {
      const Line line = random_line(schwarze, rng);
      if (oracle.roots(line, -5, 30).near_touch) continue;
      const std::vector<Hit> a = hits_of(schwarze, line, -5, 30);
      const std::vector<Hit> b = hits_of(bracketed, line, -5, 30);
      ASSERT_EQ(a.size(), b.size()) << describe(line, -5, 30);
      for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i].t, b[i].t, 1e-6 / norm(line.direction)) << describe(line, -5, 30);
    }
  }
}

TEST(Isosurface, CountersCountSearchesAndSolves) {
  Rng rng(22);
  const ScalarGrid grid = wave_grid({24, 20, 33}, {1, 1, 1}, rng);
  SearchOptions options;
  const Isosurface pruned(grid, 0.1, options);
  options.traversal = Traversal::kKdTree;
  const Isosurface tree(grid, 0.1, options);
  options.min_max_pruning = false;
  const Isosurface unpruned(grid, 0.1, options);
  SearchCounters a;
  SearchCounters b;
  SearchCounters c;
  std::uint64_t with_hits = 0;
  std::vector<Hit> hits;
  for (int trial = 0; trial < 1000; ++trial) {
    const Line line = random_line(pruned, rng);
    const SearchCounters before = a;
    pruned.all_hits(line, 0, 10, hits, a);
    with_hits += static_cast<std::uint64_t>(!hits.empty());
    EXPECT_GE(a.solves - before.solves, (hits.size() + 2) / 3);
    tree.all_hits(line, 0, 10, hits, b);
    unpruned.all_hits(line, 0, 10, hits, c);
  }
  EXPECT_EQ(a.searches, 1000u);
  EXPECT_EQ(a.searches_hit, with_hits);
  EXPECT_EQ(a.solves, b.solves);
  EXPECT_EQ(a.solves_hit, b.solves_hit);
  EXPECT_EQ(a.searches_hit, c.searches_hit);
  EXPECT_LT(a.solves, c.solves);
  EXPECT_LE(a.solves_hit, a.solves);
}

TEST(Isosurface, RefusesALeafWithoutCells) {
  Rng rng(23);
  const ScalarGrid grid = noise_grid({3, 3, 3}, {1, 1, 1}, rng);
  SearchOptions options;
  options.leaf_cells = 0;
  EXPECT_THROW(Isosurface(grid, 127.5, options), InputError);
}

}  // namespace
}  // namespace deliso
