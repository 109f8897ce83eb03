// Marching cubes against the exact topology, and its geometry against the trilinear interpolant.
#include "volume/marching_cubes/marching_cubes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_mesh_check.h"
#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"
#include "volume/topology/exact_topology.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

double value_at(const ScalarGrid& grid, const Vec3& p) {
  std::array<std::int32_t, 3> cell{};
  for (std::size_t a = 0; a < 3; ++a) cell[a] = std::clamp(static_cast<std::int32_t>(p[a]), 0, grid.dims()[a] - 2);
  const Vec3 base{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
  return trilinear_value(grid.cell(cell[0], cell[1], cell[2]), p - base);
}

bool on_box(const ScalarGrid& grid, const Vec3& a, const Vec3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double plane : {0.0, grid.dims()[axis] - 1.0}) {
      if (a[axis] == plane && b[axis] == plane) return true;
    }
  }
  return false;
}

double signed_volume(const MarchingCubesMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) volume += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  return volume;
}

TEST(MarchingCubes, IsAManifoldWithTheExactTopologyOnRandomGrids) {
  Rng rng(31);
  int tunnels = 0;
  for (int i = 0; i < 400; ++i) {
    const std::int64_t range = std::array{2, 6, 1000}[rng.below(3)];
    const test::IntegerGrid integers = test::random_integer_grid(rng, test::random_dims(rng, 8), range);
    const ScalarGrid grid = test::scalar_grid(integers);
    const IsosurfaceTopology topology = exact_topology(grid, -0.5);
    const MarchingCubesMesh mesh = marching_cubes(grid, -0.5);
    // Also where the isovalue is that of a saddle: then the mesh and the counts take the same side.
    const test::MeshFacts facts = test::mesh_facts(mesh.triangles);
    ASSERT_EQ(facts.defect, "") << "case " << i << " after seed 31";
    ASSERT_EQ(facts.components, test::sorted_components(topology)) << "case " << i << " after seed 31";
    ASSERT_EQ(mesh.crossing_count, topology.crossings.size());
    if (mesh.points.size() > mesh.crossing_count) ++tunnels;
    for (std::size_t v = 0; v < mesh.crossing_count; ++v) {
      ASSERT_EQ(mesh.points[v], crossing_position(grid, topology.crossings[v]));
    }
    for (const auto& [a, b] : facts.boundary) ASSERT_TRUE(on_box(grid, mesh.points[a], mesh.points[b])) << "case " << i;
  }
  EXPECT_GT(tunnels, 20);
}

TEST(MarchingCubes, MeetsEveryKindOfCell) {
  Rng rng(32);
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> samples;
    for (int c = 0; c < 8; ++c) samples.push_back(rng.uniform(-1, 1));
    // Every other time two opposite corners stand out, which makes tunnels common.
    if (i % 2 == 0) samples[0] = samples[7] = rng.uniform(0.5, 3);
    const ScalarGrid grid({2, 2, 2}, samples);
    const test::MeshFacts facts = test::mesh_facts(marching_cubes(grid, 0).triangles);
    ASSERT_EQ(facts.defect, "") << "case " << i << " after seed 32";
    ASSERT_EQ(facts.components, test::sorted_components(exact_topology(grid, 0))) << "case " << i << " after seed 32";
  }
}

TEST(MarchingCubes, FacesLowerValues) {
  // Higher inside: the mesh of a ball is counterclockwise seen from outside, so its signed volume is positive.
  std::vector<double> samples;
  for (int k = 0; k < 24; ++k) {
    for (int j = 0; j < 24; ++j) {
      for (int i = 0; i < 24; ++i) samples.push_back(8 - std::hypot(i - 11.3, j - 11.6, k - 11.8));
    }
  }
  const double ball = 4.0 / 3 * 3.14159265358979 * 8 * 8 * 8;
  EXPECT_NEAR(signed_volume(marching_cubes(ScalarGrid({24, 24, 24}, samples), 0)), ball, 0.02 * ball);
  for (double& sample : samples) sample = -sample;
  EXPECT_NEAR(signed_volume(marching_cubes(ScalarGrid({24, 24, 24}, samples), 0)), -ball, 0.02 * ball);
}

TEST(MarchingCubes, VerticesLieOnTheSurface) {
  Rng rng(33);
  const test::IntegerGrid integers = test::random_integer_grid(rng, {14, 13, 12}, 100);
  const ScalarGrid grid = test::scalar_grid(integers);
  const MarchingCubesMesh mesh = marching_cubes(grid, -0.5);
  std::size_t inner_on_surface = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double residual = std::abs(value_at(grid, mesh.points[v]) + 0.5);
    if (v < mesh.crossing_count) {
      ASSERT_LT(residual, 1e-9) << "vertex " << v;
    } else if (residual < 1e-3) {
      ++inner_on_surface;
    }
  }
  // Points of rings around tunnels are projected by a few steps; nearly all arrive.
  const std::size_t inner = mesh.points.size() - mesh.crossing_count;
  EXPECT_GT(inner, 20u);
  EXPECT_GT(inner_on_surface, inner * 9 / 10);
}

TEST(MarchingCubes, PlacesItsVerticesInTheWorld) {
  Rng rng(34);
  const test::IntegerGrid integers = test::random_integer_grid(rng, {5, 6, 7}, 100);
  const ScalarGrid plain = test::scalar_grid(integers);
  const Vec3 spacing{0.5, 2, 3};
  const Vec3 origin{-1, 10, 100};
  const ScalarGrid placed(plain.dims(), plain.samples(), spacing, origin);
  const MarchingCubesMesh a = marching_cubes(plain, -0.5);
  const MarchingCubesMesh b = marching_cubes(placed, -0.5);
  ASSERT_EQ(a.triangles, b.triangles);
  for (std::size_t v = 0; v < a.points.size(); ++v) EXPECT_EQ(b.points[v], origin + scaled(a.points[v], spacing));
}

TEST(MarchingCubes, HasThePapersVertexCountOnAtom) {
  const auto directory = data_directory();
  if (!directory) GTEST_SKIP() << "DELISO_DATA is not set";
  const ScalarGrid grid = read_volume(*directory / "hydrogen_atom.nrrd");
  const MarchingCubesMesh mesh = marching_cubes(grid, 20.1);
  EXPECT_EQ(mesh.points.size(), 22498u);  // Dey and Levine, Figure 1
  const test::MeshFacts facts = test::mesh_facts(mesh.triangles);
  EXPECT_EQ(facts.defect, "");
  EXPECT_EQ(facts.components, (std::vector<ComponentTopology>{{0, 0}, {2, 0}, {2, 0}, {2, 0}}));
}

}  // namespace
}  // namespace deliso
