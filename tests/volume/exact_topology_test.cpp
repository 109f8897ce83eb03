// The exact topology of whole grids: known fields, public volumes, refined and turned grids, a fine lattice.
#include "volume/exact_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_oracle.h"
#include "tests/support/volume_files.h"
#include "volume/exact_topology_cell.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

using Components = std::vector<ComponentTopology>;

ScalarGrid sampled(const Dims& dims, const std::function<double(const Vec3&)>& field) {
  std::vector<double> samples;
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        samples.push_back(field({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
      }
    }
  }
  return {dims, samples};
}

Components components_of(const ScalarGrid& grid, double isovalue) {
  return test::sorted_components(exact_topology(grid, isovalue));
}

Components components_of(const test::IntegerGrid& grid) {
  return components_of(test::scalar_grid(grid), test::isovalue_of(grid));
}

bool is_singular(const test::IntegerGrid& grid) {
  return !exact_topology(test::scalar_grid(grid), test::isovalue_of(grid)).singular_cells.empty();
}

TEST(ExactTopology, KnowsSimpleSurfaces) {
  const Vec3 center{9.6, 9.3, 9.2};
  const auto ball = [&](const Vec3& p) { return 7.1 - distance(p, center); };
  EXPECT_EQ(components_of(sampled({20, 19, 21}, ball), 0), (Components{{2, 0}}));
  const auto shell = [&](const Vec3& p) { return 1.3 - std::abs(distance(p, center) - 5.5); };
  EXPECT_EQ(components_of(sampled({20, 19, 21}, shell), 0), (Components{{2, 0}, {2, 0}}));
  const auto ring = [&](const Vec3& p) {
    const Vec3 d = p - center;
    return 2.2 - std::hypot(std::hypot(d.x, d.y) - 5.6, d.z);
  };
  EXPECT_EQ(components_of(sampled({20, 19, 21}, ring), 0), (Components{{0, 0}}));
  const auto plane = [](const Vec3& p) { return p.x + 0.3 * p.y + 0.2 * p.z - 8.05; };
  EXPECT_EQ(components_of(sampled({20, 19, 21}, plane), 0), (Components{{1, 1}}));
  const auto cylinder = [&](const Vec3& p) { return 5.3 - std::hypot(p.x - center.x, p.y - center.y); };
  EXPECT_EQ(components_of(sampled({20, 19, 21}, cylinder), 0), (Components{{0, 2}}));
  const auto corner_ball = [](const Vec3& p) { return 4.2 - norm(p); };
  EXPECT_EQ(components_of(sampled({9, 9, 9}, corner_ball), 0), (Components{{1, 1}}));
  EXPECT_TRUE(components_of(sampled({5, 5, 5}, ball), 100).empty());
}

struct PublicVolume {
  std::string file;
  double isovalue;
  Components large;      // the components that are not spheres
  std::int64_t spheres;  // the rest
};

TEST(ExactTopology, CountsThePublicVolumesExactly) {
  const auto directory = data_directory();
  if (!directory) GTEST_SKIP() << "DELISO_DATA is not set";
  const std::vector<PublicVolume> volumes{
      {"fuel.nrrd", 70.1, {{-7, 1}}, 0},
      {"hydrogen_atom.nrrd", 20.1, {{0, 0}}, 3},
      {"engine.nrrd", 40.1, {{-42, 0}}, 7},
      {"baby.nrrd", 35.8, {{-30, 6}, {-4, 4}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}, 165},
      {"baby.nrrd", 131.6, {{-274, 2}, {-21, 1}, {0, 0}, {1, 1}, {1, 1}}, 117},
      {"aneurism.nrrd", 124.6, {{-78, 0}, {0, 0}, {0, 0}}, 708},
  };
  for (const PublicVolume& volume : volumes) {
    Components expected = volume.large;
    expected.insert(expected.end(), static_cast<std::size_t>(volume.spheres), {2, 0});
    EXPECT_EQ(components_of(read_volume(*directory / volume.file), volume.isovalue), expected) << volume.file;
  }
}

TEST(ExactTopology, AgreesWithAFineLatticeOnRandomGrids) {
  Rng rng(21);
  int checked = 0;
  for (int i = 0; i < 1200; ++i) {
    // Small values keep necks wide enough for the lattice.
    const std::int64_t range = std::array{2, 5, 10}[rng.below(3)];
    const Dims dims = test::random_dims(rng, i % 100 == 0 ? 6 : 3);
    const test::IntegerGrid grid = test::random_integer_grid(rng, dims, range);
    if (is_singular(grid)) continue;
    const Components ours = components_of(grid);
    // The lattice may be too coarse for thin necks: it is refined until it agrees, up to a limit.
    bool agrees = false;
    for (int n = 3; n <= 48 && !agrees; n *= 2) agrees = test::lattice_topology(grid, n) == ours;
    ASSERT_TRUE(agrees) << "case " << i << " after seed 21";
    ++checked;
  }
  EXPECT_GT(checked, 800);
}

TEST(ExactTopology, ARefinedGridHasTheSameTopology) {
  Rng rng(22);
  for (int i = 0; i < 300; ++i) {
    const std::int64_t range = std::array{3, 10, 100000}[rng.below(3)];
    const test::IntegerGrid grid = test::random_integer_grid(rng, test::random_dims(rng, 6), range);
    if (is_singular(grid)) continue;
    const Components ours = components_of(grid);
    for (const std::int32_t n : {3, 5}) {
      // n^3 is odd: no refined sample, an integer, equals the isovalue, half of an odd one.
      ASSERT_EQ(components_of(test::refined(grid, n)), ours) << "case " << i << " after seed 22, times " << n;
    }
  }
}

TEST(ExactTopology, ATurnedOrMirroredGridHasTheSameTopology) {
  Rng rng(23);
  for (int i = 0; i < 60; ++i) {
    const std::int64_t range = std::array{2, 4, 1000000}[rng.below(3)];
    const test::IntegerGrid grid = test::random_integer_grid(rng, test::random_dims(rng, 7), range);
    if (is_singular(grid)) continue;
    const Components ours = components_of(grid);
    for (const test::CubeSymmetry& symmetry : test::cube_symmetries()) {
      ASSERT_EQ(components_of(test::transformed(grid, symmetry)), ours) << "case " << i << " after seed 23";
    }
  }
}

TEST(ExactTopology, SingularGridsStaySingularWhenTurned) {
  Rng rng(24);
  int singular = 0;
  for (int i = 0; i < 200; ++i) {
    const test::IntegerGrid grid = test::random_integer_grid(rng, {3, 3, 3}, 2);
    const bool ours = is_singular(grid);
    singular += ours ? 1 : 0;
    for (const test::CubeSymmetry& symmetry : test::cube_symmetries()) {
      ASSERT_EQ(is_singular(test::transformed(grid, symmetry)), ours) << "case " << i << " after seed 24";
    }
  }
  EXPECT_GT(singular, 20);
}

// f(x, y) + slope z around a face with a saddle at 0: the surface passes through the face like a graph.
TEST(ExactTopology, ASaddleOnAFaceIsRegularWhereTheSurfacePassesThrough) {
  const auto field = [](double below, double above) {
    return sampled({2, 2, 3}, [=](const Vec3& p) {
      const double saddle = (3 * p.x - 1) * (5 * p.y - 2);  // its corners are 2, -3, -4, 6
      return saddle + (p.z < 1 ? below * (1 - p.z) : above * (p.z - 1));
    });
  };
  for (const double slope : {7.5, -7.5, 0.25}) {
    EXPECT_TRUE(exact_topology(field(-slope, slope), 0).singular_cells.empty()) << slope;
    EXPECT_EQ(components_of(field(-slope, slope), 0), components_of(field(-slope, slope), 1e-9)) << slope;
    EXPECT_EQ(components_of(field(-slope, slope), 0), components_of(field(-slope, slope), -1e-9)) << slope;
    EXPECT_EQ(exact_topology(field(slope, slope), 0).singular_cells.size(), 2u) << slope;
  }
}

// Four values, -3/2, -1/2, 1/2 and 3/2 from the isovalue: saddles of faces at the isovalue are common.
TEST(ExactTopology, AgreesWithAFineLatticeOnRegularGridsFullOfTies) {
  Rng rng(30);
  int with_ties = 0;
  for (int i = 0; i < 6000; ++i) {
    const test::IntegerGrid grid = test::random_integer_grid(rng, i % 2 == 0 ? Dims{2, 2, 3} : Dims{3, 3, 3}, 2);
    const IsosurfaceTopology topology = exact_topology(test::scalar_grid(grid), -0.5);
    if (!topology.singular_cells.empty()) continue;
    bool ties = false;
    topology.index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t) {
      ties = ties || CellSweep(test::scalar_grid(grid).cell(cell[0], cell[1], cell[2]), -0.5).saddle_faces() != 0;
    });
    if (!ties) continue;
    ++with_ties;
    bool agrees = false;
    for (int n = 3; n <= 24 && !agrees; n *= 2)
      agrees = test::lattice_topology(grid, n) == test::sorted_components(topology);
    ASSERT_TRUE(agrees) << "case " << i << " after seed 30";
  }
  EXPECT_GT(with_ties, 20);
}

TEST(ExactTopology, DoesNotDependOnTheSampleType) {
  Rng rng(25);
  const Dims dims{70, 9, 8};
  const auto count = static_cast<std::size_t>(dims[0] * dims[1] * dims[2]);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(rng.below(100)));
  const Components expected = components_of(ScalarGrid(dims, bytes), 70.3);
  ASSERT_GT(expected.size(), 10u);
  const auto check = [&](auto zero) {
    std::vector<decltype(zero)> samples(bytes.begin(), bytes.end());
    EXPECT_EQ(components_of(ScalarGrid(dims, samples), 70.3), expected);
  };
  check(std::int8_t{});
  check(std::uint16_t{});
  check(std::int16_t{});
  check(std::int32_t{});
  check(float{});
  check(double{});
}

TEST(ExactTopology, IsovaluesBeyondTheTypeFindNothing) {
  const ScalarGrid grid({2, 2, 2}, std::vector<std::uint8_t>{0, 255, 0, 255, 0, 255, 0, 255});
  for (const double isovalue : {-1e300, -0.5, 255.5, 1e300}) {
    EXPECT_TRUE(exact_topology(grid, isovalue).components.empty()) << isovalue;
  }
  EXPECT_EQ(components_of(grid, 254.999), (Components{{1, 1}}));
}

TEST(ExactTopology, RefusesAnIsovalueThatASampleHas) {
  EXPECT_THROW(exact_topology(ScalarGrid({2, 2, 2}, std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7}), 3),
               InternalError);
  EXPECT_THROW(exact_topology(ScalarGrid({2, 2, 2}, std::vector<double>{0, 1, 2, 3.5, 4, 5, 6, 7}), 3.5),
               InternalError);
}

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

// Many slabs of layers, many components across them, cells with saddles and singular cells on both sides of the cuts.
TEST(ExactTopology, IsTheSameForAnyNumberOfThreads) {
  Rng rng(41);
  std::size_t saddles = 0;
  std::size_t singular_cells = 0;
  for (const std::int32_t layers : {2, 8, 9, 17, 40, 45}) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, {70, 6, layers}, 6);
    const ScalarGrid grid = test::scalar_grid(integers);
    const double isovalue = test::isovalue_of(integers);
    const IsosurfaceTopology one = exact_topology(grid, isovalue, 1);
    saddles += one.saddles.size();
    singular_cells += one.singular_cells.size();
    for (const int threads : {2, 3, 5}) {
      const IsosurfaceTopology many = exact_topology(grid, isovalue, threads);
      ASSERT_EQ(many.components, one.components) << layers;
      ASSERT_EQ(many.crossings.size(), one.crossings.size()) << layers;
      for (std::size_t i = 0; i < one.crossings.size(); ++i) {
        const EdgeCrossing &a = one.crossings[i], &b = many.crossings[i];
        ASSERT_TRUE(a.sample == b.sample && a.axis == b.axis && a.component == b.component && a.t == b.t) << layers;
      }
      ASSERT_EQ(many.saddles.size(), one.saddles.size()) << layers;
      for (std::size_t i = 0; i < one.saddles.size(); ++i) {
        const SurfaceSaddle &a = one.saddles[i], &b = many.saddles[i];
        ASSERT_TRUE(a.cell == b.cell && a.position == b.position && a.component == b.component) << layers;
      }
      ASSERT_EQ(many.singular_cells, one.singular_cells) << layers;
    }
  }
  EXPECT_GT(saddles, 100u);
  EXPECT_GT(singular_cells, 10u);
}

TEST(ExactTopology, RefusesASampleAtTheIsovalueInAnySlab) {
  for (const std::int32_t layer : {0, 7, 8, 19}) {
    std::vector<double> samples(4 * 4 * 20, 1);
    samples[16 * static_cast<std::size_t>(layer) + 5] = 2.5;
    EXPECT_THROW(exact_topology(ScalarGrid({4, 4, 20}, samples), 2.5, 3), InternalError) << layer;
  }
}

}  // namespace
}  // namespace deliso
