// What the exact topology says of single points: the crossings, the arcs between them, the component of a point.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

using test::is_singular;
using test::sampled;

TEST(ExactTopology, ListsEveryCrossingInOrder) {
  Rng rng(26);
  for (const Dims& dims : {Dims{2, 3, 4}, Dims{63, 3, 3}, Dims{64, 4, 2}, Dims{65, 3, 3}, Dims{130, 2, 3}}) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, dims, 50);
    const ScalarGrid grid = test::scalar_grid(integers);
    const double isovalue = test::isovalue_of(integers);
    const IsosurfaceTopology topology = exact_topology(grid, isovalue);
    std::size_t next = 0;
    std::uint32_t components = 0;
    for (std::int32_t k = 0; k < dims[2]; ++k) {
      for (std::int32_t j = 0; j < dims[1]; ++j) {
        for (std::int32_t i = 0; i < dims[0]; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            std::array<std::int32_t, 3> end{i, j, k};
            ++end[static_cast<std::size_t>(axis)];
            const bool leaves = end[0] == dims[0] || end[1] == dims[1] || end[2] == dims[2];
            const double low = grid.at(i, j, k);
            if (leaves || (low > isovalue) == (grid.at(end[0], end[1], end[2]) > isovalue)) {
              ASSERT_EQ(topology.index.find(i, j, k, axis), CrossingIndex::kNone);
              continue;
            }
            ASSERT_EQ(topology.index.find(i, j, k, axis), next);
            const EdgeCrossing& crossing = topology.crossings[next++];
            ASSERT_EQ(crossing.sample, grid.index(i, j, k));
            ASSERT_EQ(crossing.axis, axis);
            const double high = grid.at(end[0], end[1], end[2]);
            ASSERT_NEAR(low + crossing.t * (high - low), isovalue, 1e-12);
            const Vec3 expected = Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} +
                                  crossing.t * Vec3{end[0] - i + 0.0, end[1] - j + 0.0, end[2] - k + 0.0};
            ASSERT_EQ(crossing_position(grid, crossing), expected);
            // Components are numbered as they appear.
            ASSERT_LE(crossing.component, components);
            if (crossing.component == components) ++components;
          }
        }
      }
    }
    EXPECT_EQ(next, topology.crossings.size());
    EXPECT_EQ(components, topology.components.size());
  }
}

TEST(ExactTopology, CrossingsStayInsideTheirEdge) {
  const double huge = 1.7e308;
  const ScalarGrid grid({2, 2, 2}, std::vector<double>{-huge, huge, -1e-300, huge, -huge, 1e-300, -1, 1e-300});
  for (const EdgeCrossing& crossing : exact_topology(grid, 0).crossings) {
    EXPECT_GT(crossing.t, 0);
    EXPECT_LT(crossing.t, 1);
  }
}

// Differences that overflow, and places that round to an end.
TEST(EdgeParameter, IsAFractionAlsoOfHugeAndOfUnevenSegments) {
  const double huge = 1.7e308;
  EXPECT_DOUBLE_EQ(edge_parameter(-huge, huge, 0), 0.5);
  EXPECT_DOUBLE_EQ(edge_parameter(huge, -huge, huge / 2), 0.25);
  EXPECT_DOUBLE_EQ(edge_parameter(-huge, huge, huge / 2), 0.75);
  EXPECT_DOUBLE_EQ(edge_parameter(-1, 3, 0), 0.25);
  for (const double t : {edge_parameter(-1e-300, huge, 0), edge_parameter(-huge, 1e-300, 0)})
    EXPECT_TRUE(0 < t && t < 1);
}

std::vector<FaceArc> all_face_arcs(const ScalarGrid& grid, double isovalue, const CrossingIndex& index) {
  std::vector<FaceArc> all;
  const Dims& dims = grid.dims();
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        const CellIndex corner{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          if (corner[u] + 1 == dims[u] || corner[v] + 1 == dims[v]) continue;
          const FaceArcs arcs = face_arcs(grid, isovalue, index, corner, static_cast<int>(axis));
          all.insert(all.end(), arcs.arcs.begin(), arcs.arcs.begin() + arcs.count);
        }
      }
    }
  }
  return all;
}

TEST(FaceArcs, ADisksBoundaryIsMadeOfThem) {
  Rng rng(27);
  for (int i = 0; i < 200; ++i) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, test::random_dims(rng, 6), 5);
    const ScalarGrid grid = test::scalar_grid(integers);
    const double isovalue = test::isovalue_of(integers);
    const IsosurfaceTopology topology = exact_topology(grid, isovalue);
    std::vector<int> degree(topology.crossings.size());
    std::map<std::uint32_t, std::int64_t> outer;
    for (const FaceArc& arc : all_face_arcs(grid, isovalue, topology.index)) {
      ASSERT_NE(arc.crossings[0], arc.crossings[1]);
      ASSERT_EQ(topology.crossings[arc.crossings[0]].component, topology.crossings[arc.crossings[1]].component);
      for (const std::uint32_t c : arc.crossings) ++degree[c];
    }
    // A crossing ends one arc on every grid face at its edge.
    for (std::size_t c = 0; c < degree.size(); ++c) {
      const Vec3 p = crossing_position(grid, topology.crossings[c]);
      int faces = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        if (a == topology.crossings[c].axis) continue;
        faces += (p[a] > 0 ? 1 : 0) + (p[a] < grid.dims()[a] - 1 ? 1 : 0);
      }
      ASSERT_EQ(degree[c], faces) << "case " << i << " after seed 27";
    }
  }
}

// All crossings of a refined grid are points of the same surface; their components follow from those among them that
// lie on the coarse grid's edges.
TEST(ComponentOf, AgreesWithTheComponentsOfARefinedGrid) {
  Rng rng(28);
  int checked = 0;
  for (int i = 0; i < 120; ++i) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, test::random_dims(rng, 6), i % 2 == 0 ? 6 : 1000);
    if (is_singular(integers)) continue;
    const ScalarGrid grid = test::scalar_grid(integers);
    const double isovalue = test::isovalue_of(integers);
    const IsosurfaceTopology topology = exact_topology(grid, isovalue);
    constexpr std::int32_t kSteps = 3;
    const test::IntegerGrid fine_integers = test::refined(integers, kSteps);
    const ScalarGrid fine = test::scalar_grid(fine_integers);
    const IsosurfaceTopology fine_topology = exact_topology(fine, test::isovalue_of(fine_integers));

    std::vector<std::uint32_t> coarse_of(fine_topology.components.size(), CrossingIndex::kNone);
    for (std::int32_t pass = 0; pass < 2; ++pass) {
      for (const EdgeCrossing& crossing : fine_topology.crossings) {
        const Vec3 p = crossing_position(fine, crossing) / kSteps;
        std::uint32_t& coarse = coarse_of[crossing.component];
        if (pass == 0) {
          // The edge of the coarse grid that holds the fine edge, if any.
          std::array<std::int32_t, 3> sample{};
          bool on_edge = true;
          for (std::size_t a = 0; a < 3; ++a) {
            sample[a] = static_cast<std::int32_t>(p[a]);
            on_edge = on_edge && (a == crossing.axis || p[a] == sample[a]);
          }
          if (!on_edge) continue;
          const std::uint32_t number = topology.index.find(sample[0], sample[1], sample[2], crossing.axis);
          ASSERT_NE(number, CrossingIndex::kNone);
          coarse = topology.crossings[number].component;
        } else {
          const auto found = component_of(grid, isovalue, topology, p);
          ASSERT_TRUE(found.has_value());
          ASSERT_EQ(*found, coarse) << "case " << i << " after seed 28 at " << p.x << " " << p.y << " " << p.z;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 20000);
}

TEST(ComponentOf, KnowsCrossingsSaddlesAndEmptySpace) {
  Rng rng(29);
  const test::IntegerGrid integers = test::random_integer_grid(rng, {12, 12, 12}, 1000);
  const ScalarGrid grid = test::scalar_grid(integers);
  const IsosurfaceTopology topology = exact_topology(grid, -0.5);
  for (const EdgeCrossing& crossing : topology.crossings) {
    ASSERT_EQ(component_of(grid, -0.5, topology, crossing_position(grid, crossing)), crossing.component);
  }
  ASSERT_GT(topology.saddles.size(), 10u);
  for (const SurfaceSaddle& saddle : topology.saddles) {
    ASSERT_EQ(component_of(grid, -0.5, topology, saddle.position), saddle.component);
  }
  const ScalarGrid ball = sampled({20, 20, 20}, [](const Vec3& p) { return 4.1 - distance(p, {10, 10, 10}); });
  EXPECT_EQ(component_of(ball, 0, exact_topology(ball, 0), {1.5, 1.5, 1.5}), std::nullopt);
}

}  // namespace
}  // namespace deliso
