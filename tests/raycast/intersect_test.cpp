// Figure 12 in plain code, against brute force; and the ray caster's own searches, which must find the same to the last
// bit.
#include "raycast/intersect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "tests/support/raycast_cases.h"
#include "tests/support/raycast_fields.h"

namespace deliso {
namespace {

using testing::Case;
using testing::cases;
using testing::describe;
using testing::hits_of;
using testing::random_line;
using testing::sampled_grid;

constexpr double kEndless = std::numeric_limits<double>::infinity();

// The cases of all tests of rays, and steps between whole numbers: many cells with one value at all corners.
std::vector<Case> all_cases() {
  std::vector<Case> list = cases();
  Rng rng(41);
  list.push_back({sampled_grid<std::int16_t>({13, 9, 11}, {1, 1, 1}, [&](auto...) { return rng.below(4) / 3; }), 0.5});
  return list;
}

LineSegment segment_on(const Isosurface& surface, const ScalarGrid& grid, const Line& line, double t0, double t1) {
  const Vec3& step = surface.step();
  return {line, t0, t1, {1 / step.x, 1 / step.y, 1 / step.z}, grid.dims()};
}

// Of random length and place; at times a whole line, at times one that grazes the isosurface.
struct SegmentQuery {
  Line line;
  double t0 = 0;
  double t1 = 0;
};
SegmentQuery random_segment(const Isosurface& surface, Rng& rng) {
  SegmentQuery query{random_line(surface, rng), 0, 0};
  const std::vector<Hit> hits = hits_of(surface, query.line, -kEndless, kEndless);
  if (!hits.empty() && rng.below(4) == 0) {
    query.line.origin = query.line.at(hits.front().t);
    const Vec3 gradient = surface.gradient(query.line.origin);
    if (norm(gradient) > 0) query.line.direction = cross(gradient, query.line.direction) / norm(gradient);
  }
  const bool is_whole = rng.below(4) == 0;
  query.t0 = is_whole ? -kEndless : rng.uniform(-20, 20);
  query.t1 = is_whole ? kEndless : rng.uniform(query.t0, 40);
  return query;
}

// Do samples of an extended cell lie on both sides of the isovalue?
bool spans(const ScalarGrid& grid, const Cell& cell, double isovalue) {
  const Dims& dims = grid.dims();
  int above = 0;
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    const auto at = [&](std::size_t a) {
      return std::clamp(cell[a] - 1 + ((corner >> a) & 1), std::int32_t{0}, dims[a] - 1);
    };
    above += grid.at(at(0), at(1), at(2)) > isovalue ? 1 : 0;
  }
  return above > 0 && above < 8;
}

// Does the segment pass an extended cell? By slabs: it comes into the last of them before it leaves the first.
bool passes(const LineSegment& r, const Cell& cell) {
  std::pair<double, std::size_t> in(-kEndless, 0), out(kEndless, 0);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax(r.first[a], r.last[a]);
    if (cell[a] < low || cell[a] > high) return false;
    const bool is_upward = r.first[a] < r.last[a];
    const std::int32_t entered = is_upward ? cell[a] - 1 : cell[a], left = is_upward ? cell[a] : cell[a] - 1;
    if (cell[a] != r.first[a]) in = std::max(in, {r.line.crossing(a, entered), a});
    if (cell[a] != r.last[a]) out = std::min(out, {r.line.crossing(a, left), a});
  }
  return in < out;
}

std::vector<Cell> voxels_by_brute_force(const ScalarGrid& grid, double isovalue, const LineSegment& r) {
  const Dims& dims = grid.dims();
  std::vector<Cell> voxels;
  for (std::int32_t k = 0; k <= dims[2]; ++k)
    for (std::int32_t j = 0; j <= dims[1]; ++j)
      for (std::int32_t i = 0; i <= dims[0]; ++i)
        if (passes(r, {i, j, k}) && spans(grid, {i, j, k}, isovalue)) voxels.push_back({i, j, k});
  return voxels;
}

TEST(Intersect, VoxelsAreThoseOfBruteForceFrontToBack) {
  for (const Case& c : all_cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    for (const std::int32_t leaf_cells : {1, 5, 64}) {
      const MinMaxKdTree tree(c.grid, leaf_cells);
      Rng rng(42);
      std::size_t found = 0;
      for (int trial = 0; trial < 150; ++trial) {
        const auto [line, t0, t1] = random_segment(surface, rng);
        const LineSegment r = segment_on(surface, c.grid, line, t0, t1);
        const std::vector<CellVisit> voxels = collect_voxels(c.grid, tree, c.isovalue, r);
        std::vector<Cell> cells;
        for (const CellVisit& voxel : voxels) cells.push_back(voxel.cell);
        for (std::size_t i = 0; i < voxels.size(); ++i) {
          ASSERT_LE(voxels[i].in.s, voxels[i].out.s) << describe(line, t0, t1);
          if (i > 0) {
            ASSERT_LE(voxels[i - 1].out.s, voxels[i].in.s) << describe(line, t0, t1);
          }
        }
        std::vector<Cell> expected = voxels_by_brute_force(c.grid, c.isovalue, r);
        std::sort(cells.begin(), cells.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(cells, expected) << describe(line, t0, t1);
        found += cells.size();
      }
      EXPECT_GT(found, 50u);
    }
  }
}

TEST(Intersect, HitsAreThoseOfEverySearchBitForBit) {
  for (const Case& c : all_cases()) {
    const MinMaxKdTree tree(c.grid, 1);
    for (const CubicSolver solver : {CubicSolver::kBracketed, CubicSolver::kSchwarze})
      for (const Traversal traversal : {Traversal::kKdTree, Traversal::kCellWalk})
        for (const bool pruning : {true, false}) {
          SearchOptions options;
          options.solver = solver;
          options.traversal = traversal;
          options.min_max_pruning = pruning;
          const Isosurface surface(c.grid, c.isovalue, options);
          Rng rng(43);
          std::size_t found = 0;
          for (int trial = 0; trial < 1500; ++trial) {
            const auto [line, t0, t1] = random_segment(surface, rng);
            const LineSegment r = segment_on(surface, c.grid, line, t0, t1);
            const std::vector<Hit> hits = intersect(c.grid, tree, c.isovalue, solver, r);
            const std::vector<Hit> fast = hits_of(surface, line, t0, t1);
            ASSERT_EQ(hits.size(), fast.size()) << describe(line, t0, t1);
            for (std::size_t i = 0; i < hits.size(); ++i) {
              ASSERT_EQ(hits[i].t, fast[i].t) << describe(line, t0, t1);
              ASSERT_EQ(hits[i].falling, fast[i].falling) << describe(line, t0, t1);
              ASSERT_LE(i > 0 ? hits[i - 1].t : t0, hits[i].t) << describe(line, t0, t1);
            }
            found += hits.size();
          }
          EXPECT_GT(found, 200u);
        }
  }
}

TEST(Intersect, EveryVoxelIsOneSolveOfThePrunedSearches) {
  for (const Case& c : all_cases()) {
    for (const Traversal traversal : {Traversal::kKdTree, Traversal::kCellWalk}) {
      SearchOptions options;
      options.traversal = traversal;
      const Isosurface surface(c.grid, c.isovalue, options);
      const MinMaxKdTree tree(c.grid, 1);
      Rng rng(44);
      for (int trial = 0; trial < 1000; ++trial) {
        const auto [line, t0, t1] = random_segment(surface, rng);
        const LineSegment r = segment_on(surface, c.grid, line, t0, t1);
        std::vector<Hit> hits;
        SearchCounters counters;
        surface.all_hits(line, t0, t1, hits, counters);
        ASSERT_EQ(collect_voxels(c.grid, tree, c.isovalue, r).size(), counters.solves) << describe(line, t0, t1);
      }
    }
  }
}

}  // namespace
}  // namespace deliso
