// Which component points lie on: along walls, and in blocks with one component.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "volume/filters/closing.h"
#include "volume/topology/component_blocks.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

// Bilinear between the four samples around a point of the layer k, of which one is at (i, j).
double value_in_layer(const ScalarGrid& grid, const std::array<int, 3>& sample, double u, double v, int di, int dj) {
  const auto [i, j, k] = sample;
  return (1 - u) * ((1 - v) * grid.at(i, j, k) + v * grid.at(i, j + dj, k)) +
         u * ((1 - v) * grid.at(i + di, j, k) + v * grid.at(i + di, j + dj, k));
}

// From a sample of the solid on a wall to a point of the wall with nothing between, the surface that closes the volume
// is one piece: the point lies on the component that crosses the grid edge outwards from the sample.
TEST(ComponentOf, APointOnAWallLiesOnTheSurfaceJustOutside) {
  Rng rng(31);
  int checked = 0, among_several = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<std::uint8_t> samples(64);
    for (auto& s : samples) s = static_cast<std::uint8_t>(rng.below(256));
    const ClosedGrid closed = closed_grid(ScalarGrid({4, 4, 4}, std::move(samples)), 127.5, Inside::kAbove);
    const IsosurfaceTopology topology = exact_topology(closed.grid, closed.isovalue);
    for (const int k : {1, 4}) {
      for (int corner = 0; corner < 16; ++corner) {
        const std::array<int, 3> sample{1 + corner % 4, 1 + corner / 4, k};
        if (closed.grid.at(sample[0], sample[1], k) < closed.isovalue) continue;
        const int di = sample[0] == 4 ? -1 : 1, dj = sample[1] == 4 ? -1 : 1;
        const double u = rng.uniform(0.05, 0.6), v = rng.uniform(0.05, 0.6);
        bool is_solid = true;
        for (double s = 0; s <= 1; s += 0.05) {
          is_solid = is_solid && value_in_layer(closed.grid, sample, s * u, s * v, di, dj) > closed.isovalue;
        }
        if (!is_solid) continue;
        const std::uint32_t outwards = topology.index.find(sample[0], sample[1], k == 1 ? 0 : k, 2);
        ASSERT_NE(outwards, CrossingIndex::kNone);
        const Vec3 p{sample[0] + u * di, sample[1] + v * dj, static_cast<double>(k)};
        EXPECT_EQ(component_of(closed.grid, closed.isovalue, topology, p), topology.crossings[outwards].component);
        ++checked;
        const bool is_ambiguous = closed.grid.at(sample[0] + di, sample[1] + dj, k) > closed.isovalue &&
                                  closed.grid.at(sample[0] + di, sample[1], k) < closed.isovalue &&
                                  closed.grid.at(sample[0], sample[1] + dj, k) < closed.isovalue;
        among_several += is_ambiguous ? 1 : 0;
      }
    }
  }
  EXPECT_GT(checked, 500);
  EXPECT_GT(among_several, 30);
}

// Points of a mesh that lies elsewhere: on the plane of a wall, and beyond the box or where nothing passes.
TEST(ComponentOf, APointOnTheWallOfNoSurfaceIsLookedUpWithinTheGrid) {
  const ScalarGrid ball = test::sampled({8, 8, 8}, [](const Vec3& p) { return 2.5 - distance(p, {3.5, 3.5, 3.5}); });
  for (const Inside inside : {Inside::kAbove, Inside::kBelow}) {
    const ClosedGrid closed = closed_grid(ball, 0, inside);
    const IsosurfaceTopology topology = exact_topology(closed.grid, closed.isovalue);
    ASSERT_GT(topology.components.size(), 0u);
    for (const double wall : {1.0, 8.0}) {
      for (const double y : {-40.0, 0.0, 0.5, 1.0, 4.5, 8.0, 8.7, 9.0, 12.0}) {
        for (const double z : {0.0, 1.0, 4.25, 9.0}) {
          for (const Vec3& p : {Vec3{wall, y, z}, Vec3{y, wall, z}, Vec3{z, y, wall}}) {
            const auto found = component_of(closed.grid, closed.isovalue, topology, p);
            EXPECT_TRUE(!found || *found < topology.components.size()) << p.x << ' ' << p.y << ' ' << p.z;
          }
        }
      }
    }
  }
}

TEST(ComponentBlocks, TellWhatALookupFinds) {
  Rng rng(37);
  const ScalarGrid grid = test::sampled({40, 33, 25}, [](const Vec3& p) {
    return std::max(5.3 - distance(p, {9, 9, 9}),
                    std::max(6.1 - distance(p, {28, 22, 13}), 1.2 - distance(p, {17, 9, 9})));
  });
  const IsosurfaceTopology topology = exact_topology(grid, 0);
  ASSERT_EQ(topology.components.size(), 3u);
  const ComponentBlocks blocks(grid.dims(), topology);
  int told = 0, several = 0;
  for (const EdgeCrossing& crossing : topology.crossings) {
    const Vec3 at = crossing_position(grid, crossing);
    for (int n = 0; n < 4; ++n) {
      const Vec3 p = n == 0 ? at : at + Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
      const auto only = blocks.only_component(p);
      const auto found = component_of(grid, 0, topology, p);
      if (only && found) {
        EXPECT_EQ(*only, *found);
      }
      told += only ? 1 : 0;
      several += only ? 0 : 1;
    }
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(several, 100);
}

}  // namespace
}  // namespace deliso
