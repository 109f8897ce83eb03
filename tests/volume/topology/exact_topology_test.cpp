// The exact topology of whole grids: known fields, public volumes, refined and turned grids, a fine lattice.
#include "volume/topology/exact_topology.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_oracle.h"
#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {
namespace {

using test::is_singular;
using test::sampled;

using Components = std::vector<ComponentTopology>;

Components components_of(const ScalarGrid& grid, double isovalue) {
  return test::sorted_components(exact_topology(grid, isovalue));
}

Components components_of(const test::IntegerGrid& grid) {
  return components_of(test::scalar_grid(grid), test::isovalue_of(grid));
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
      {"leg.nrrd", 22.1, {{-11, 1}, {-10, 2}, {1, 1}, {1, 1}}, 11},
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
