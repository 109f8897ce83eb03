// No triangles of marching cubes meet beyond what they share: in single cells of all kinds, and in whole volumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/intersection/exact_tests.h"
#include "tests/support/cell_mesh_check.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_mesh_check.h"
#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"
#include "volume/marching_cubes/marching_cubes.h"
#include "volume/topology/cell_sweep.h"
#include "volume/topology/exact_topology.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

ScalarGrid single_cell(const CellCorners& corners) {
  return {{2, 2, 2}, std::vector<double>(corners.begin(), corners.end())};
}

// Everything that a cell's triangles promise.
void expect_sound(const CellCorners& corners, double isovalue) {
  const ScalarGrid grid = single_cell(corners);
  const MarchingCubesMesh mesh = marching_cubes(grid, isovalue, &kExactTests);
  ASSERT_EQ(test::contacts(mesh.points, mesh.triangles), 0);
  const test::MeshFacts facts = test::mesh_facts(mesh.triangles);
  ASSERT_EQ(facts.defect, "");
  ASSERT_EQ(facts.components, test::sorted_components(exact_topology(grid, isovalue)));
  for (const auto& [a, b] : facts.boundary) {
    ASSERT_TRUE(std::max(a, b) < mesh.crossing_count);
    ASSERT_TRUE(test::runs_along_higher_values(grid, isovalue, mesh.points[a], mesh.points[b])) << a << " to " << b;
  }
  for (std::size_t v = mesh.crossing_count; v < mesh.points.size(); ++v) {
    const auto [x, y, z] = mesh.points[v];
    ASSERT_TRUE(std::min({x, y, z}) > 0 && std::max({x, y, z}) < 1) << "inner point " << v;
  }
}

// Of a point of a cell, in index space: in the first order; or, where the surface bends too much for that, the least
// distance along an axis at which the value has the other sign.
double distance_to_surface(const ScalarGrid& grid, double isovalue, const Vec3& p) {
  const auto cell_of = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  const std::array<std::int32_t, 3> cell = {cell_of(p.x), cell_of(p.y), cell_of(p.z)};
  const CellCorners corners = grid.cell(cell[0], cell[1], cell[2]);
  const Vec3 uvw{p.x - cell[0], p.y - cell[1], p.z - cell[2]};
  const double value = trilinear_value(corners, uvw) - isovalue;
  double distance = std::abs(value) / norm(trilinear_gradient(corners, uvw));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double step : {1e-4, -1e-4, 9e-4, -9e-4}) {
      Vec3 q = uvw;
      q[axis] += step;
      if ((trilinear_value(corners, q) < isovalue) != (value < 0)) distance = std::min(distance, std::abs(step));
    }
  }
  return distance;
}

// One of the sign patterns that are simple, or one of those that are not.
std::uint8_t random_pattern(Rng& rng, bool simple) {
  for (;;) {
    const auto pattern = static_cast<std::uint8_t>(rng.below(256));
    if (pattern != 0 && pattern != 255 && is_simple(pattern) == simple) return pattern;
  }
}

// The distance of a corner's value from the isovalue.
double random_magnitude(Rng& rng, int distribution, int corner) {
  switch (distribution) {
    case 0:
      return rng.uniform(1e-9, 1);
    case 1:
      return std::pow(10, rng.uniform(-5, 0));
    case 2:
      return static_cast<double>(rng.below(4)) + 0.5;
    case 3:  // two opposite corners stand out: tunnels are common
      return rng.uniform(1e-9, 1) * (corner == 0 || corner == 7 ? 5 : 1);
    case 4:  // all faces ambiguous or nearly so, saddles near the isovalue
      return 1 + 0.05 * rng.uniform(0, 1);
    default:
      return std::pow(10, rng.uniform(-13, 0));
  }
}

CellCorners random_corners(Rng& rng, int distribution, std::uint8_t pattern) {
  CellCorners corners{};
  for (int c = 0; c < 8; ++c) {
    const double magnitude = random_magnitude(rng, distribution, c);
    corners[static_cast<std::size_t>(c)] = (pattern >> c & 1) != 0 ? magnitude : -magnitude;
  }
  return corners;
}

constexpr int kDistributions = 6;

TEST(MarchingCubesEmbedding, HoldsInRandomCells) {
  int tunnels = 0, tunnels_without_inner_points = 0;
  for (std::uint64_t seed = 0; seed < 60000; ++seed) {
    Rng rng(seed);
    const bool is_plain = rng.below(10) == 0;
    const std::uint8_t pattern = random_pattern(rng, is_plain);
    const CellCorners corners = random_corners(rng, static_cast<int>(seed % kDistributions), pattern);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_sound(corners, 0);
    if (HasFatalFailure()) return;
    const CellSweep sweep(corners, 0);
    bool has_tunnel = false;
    for (int piece = 0; piece < sweep.pieces(); ++piece) has_tunnel |= sweep.euler_characteristic(piece) == 0;
    if (!has_tunnel) continue;
    ++tunnels;
    const MarchingCubesMesh mesh = marching_cubes(single_cell(corners), 0, &kExactTests);
    tunnels_without_inner_points += mesh.points.size() == mesh.crossing_count ? 1 : 0;
  }
  EXPECT_GT(tunnels, 1000);
  EXPECT_GT(tunnels_without_inner_points, 5);
}

// Cells in which a ring of inner points around the tunnel makes triangles that cross. The first four are of ENGINE.
const std::vector<std::pair<CellCorners, double>> kHardCells = {
    {{148, 151, 149, 152, 149, 152, 152, 148}, 150.2},
    {{152, 149, 149, 151, 153, 154, 146, 149}, 150.2},
    {{150, 151, 148, 150, 152, 149, 149, 151}, 150.2},
    {{150, 150, 150, 151, 152, 149, 150, 149}, 150.2},
    {{-0.5, -2.5, 3.5, 3.5, -1.5, 2.5, 1.5, -3.5}, 0},
    {{0.88, -0.21, 0.0001, -0.072, -0.0006, 0.00004, -0.061, 0.02}, 0},
    // Here the shortest bands meet, too.
    {{-0.06744209272082434, 0.025776090235123159, 0.46782386378295993, -0.15304768194783194, -0.76904375349945275,
      -0.070914881620164211, 0.92964994095125042, 0.74120646857636374},
     0},
    {{-0.0016040564662183046, 0.00055258525786119677, 0.2655343784535017, -0.038552349469544236, -0.054455319413219079,
      1.3588904112117246e-05, 0.091893561120452147, 0.13198407690790467},
     0},
    {{-2.3096620578076082e-10, 5.4365955745089972e-13, 0.0067016775817187613, -2.5796719819491025e-08,
      -3.7294798350739179e-06, 2.5364604591747268e-13, 0.0060330135930608967, 9.8735506726862578e-10},
     0},
    // Here only a part of the hull does not meet itself.
    {{-0.000878767004, -0.00268428167, 0.271832945, 1.99014568e-05, -0.000283216192, 0.00286877377, -1.93805195e-05,
      -0.000357339497},
     0},
    {{1.48696534e-05, -3.4337829e-05, 0.000478704198, -0.0586514941, -0.0113319319, 0.185868182, 0.396761951,
      -5.73279071e-05},
     0},
};

// Whether a point lies within a distance of the isosurface: the value passes through the isovalue near it.
bool is_near_surface(const CellCorners& corners, double isovalue, const Vec3& p, double distance) {
  bool is_below = false, is_above = false;
  Rng rng(1);
  for (int i = 0; i < 400; ++i) {
    const Vec3 d{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double value = trilinear_value(corners, p + distance / std::max(1.0, norm(d)) * d);
    is_below |= value <= isovalue;
    is_above |= value >= isovalue;
  }
  return is_below && is_above;
}

// Turned and mirrored in every way, with either side above.
TEST(MarchingCubesEmbedding, HoldsWhereRingsCross) {
  for (std::size_t n = 0; n < kHardCells.size(); ++n) {
    const auto& [corners, isovalue] = kHardCells[n];
    for (unsigned symmetry = 0; symmetry < 96; ++symmetry) {
      SCOPED_TRACE("cell " + std::to_string(n) + ", symmetry " + std::to_string(symmetry));
      std::array<unsigned, 3> axes{0, 1, 2};
      for (unsigned i = 0; i < symmetry / 16; ++i) std::next_permutation(axes.begin(), axes.end());
      const double sign = (symmetry & 8) != 0 ? -1 : 1;
      CellCorners turned{};
      for (unsigned c = 0; c < 8; ++c) {
        const unsigned mirrored = c ^ (symmetry & 7);
        const unsigned from = (mirrored & 1u) << axes[0] | (mirrored >> 1 & 1u) << axes[1] | (mirrored >> 2) << axes[2];
        turned[c] = sign * corners[from];
      }
      expect_sound(turned, sign * isovalue);
      if (HasFatalFailure()) return;
    }
    // What is drawn instead of the ring has its inner points on the surface.
    const MarchingCubesMesh mesh = marching_cubes(single_cell(corners), isovalue, &kExactTests);
    for (std::size_t v = mesh.crossing_count; v < mesh.points.size(); ++v) {
      EXPECT_TRUE(is_near_surface(corners, isovalue, mesh.points[v], 1e-3)) << "cell " << n << ", inner point " << v;
    }
  }
}

// Rings in symmetric cells can be only a rounding apart, and meet when the rounding differs.
TEST(MarchingCubesEmbedding, OfSymmetricCellsHoldsElsewhereAndWithOtherSpacings) {
  Rng rng(1);
  for (const CellCorners& corners : {CellCorners{0.5, 3.5, -2.5, 0.5, -0.5, 0.5, 0.5, -0.5},
                                     CellCorners{-0.5, 0.5, 1.5, -1.5, -0.5, 2.5, -2.5, 0.5}}) {
    for (int i = 0; i < 300; ++i) {
      const Vec3 spacing{rng.uniform(0.1, 2), rng.uniform(0.1, 2), rng.uniform(0.1, 2)};
      const Vec3 origin{rng.uniform(-99, 99), rng.uniform(-99, 99), rng.uniform(-99, 99)};
      const MarchingCubesMesh mesh = marching_cubes(
          ScalarGrid({2, 2, 2}, std::vector<double>(corners.begin(), corners.end()), spacing, origin), 0, &kExactTests);
      ASSERT_EQ(test::contacts(mesh.points, mesh.triangles), 0) << i;
    }
  }
}

// Beyond the first cells crossings are rounded to samples, and need no longer be corners of their hull. Then triangles
// may meet, but no cell may lose any.
TEST(MarchingCubesEmbedding, NeverCostsTheTopology) {
  int with_tunnels = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    CellCorners corners{1e-9, 1e-9, -1, 1, 1e-18, -1, -1e-18, 1};
    if (seed > 0) {
      for (double& corner : corners) corner = (rng.below(2) == 0 ? -1 : 1) * std::pow(10, rng.uniform(-20, 0));
    }
    std::vector<double> samples(64, -1);
    for (std::size_t c = 0; c < 8; ++c) {
      samples[(1 + (c & 1)) + 4 * ((1 + (c >> 1 & 1)) + 4 * (1 + (c >> 2)))] = corners[c];
    }
    const ScalarGrid grid({4, 4, 4}, samples);
    const MarchingCubesMesh mesh = marching_cubes(grid, 0, &kExactTests);
    const test::MeshFacts facts = test::mesh_facts(mesh.triangles);
    ASSERT_EQ(facts.defect, "") << "seed " << seed;
    ASSERT_TRUE(facts.boundary.empty()) << "seed " << seed;
    ASSERT_EQ(facts.components, test::sorted_components(exact_topology(grid, 0))) << "seed " << seed;
    with_tunnels += mesh.points.size() > mesh.crossing_count ? 1 : 0;
  }
  EXPECT_GT(with_tunnels, 10);
}

TEST(MarchingCubesEmbedding, HoldsInVolumesOfNoise) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed);
    const Dims dims{14, 15, 16};
    std::vector<double> samples;
    for (int i = 0; i < dims[0] * dims[1] * dims[2]; ++i) {
      samples.push_back(seed % 2 == 0 ? static_cast<double>(rng.below(12)) : rng.uniform(0, 12));
    }
    const Vec3 spacing = seed < 3 ? Vec3{1, 1, 1} : Vec3{0.3, 0.7, 1.1}, origin{-3.3, 10, 0.1};
    const ScalarGrid grid(dims, samples, spacing, origin);
    const MarchingCubesMesh mesh = marching_cubes(grid, 5.7, &kExactTests);
    EXPECT_GT(mesh.points.size(), mesh.crossing_count);
    EXPECT_EQ(test::contacts(mesh.points, mesh.triangles), 0) << "seed " << seed;
    for (std::size_t v = mesh.crossing_count; v < mesh.points.size(); ++v) {
      const Vec3 p = mesh.points[v] - origin;
      EXPECT_LT(distance_to_surface(grid, 5.7, {p.x / spacing.x, p.y / spacing.y, p.z / spacing.z}), 1e-3)
          << "seed " << seed << " point " << v;
    }
  }
}

TEST(MarchingCubesEmbedding, HoldsOnEngineInTheNoiseOfTheScan) {
  const auto directory = data_directory();
  if (!directory) GTEST_SKIP() << "DELISO_DATA is not set";
  const ScalarGrid grid = read_volume(*directory / "engine.nrrd");
  const MarchingCubesMesh mesh = marching_cubes(grid, 150.2, &kExactTests);
  EXPECT_EQ(mesh.crossing_count, 191512u);
  EXPECT_EQ(test::contacts(mesh.points, mesh.triangles), 0);
}

}  // namespace
}  // namespace deliso
