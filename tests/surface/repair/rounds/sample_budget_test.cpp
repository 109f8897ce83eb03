// Components that repair gives up: the estimate beside the lattice's own samples, and what becomes of them.
#include "surface/repair/rounds/sample_budget.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

ScalarGrid random_mask(int side, std::uint64_t seed) {
  Rng rng(seed);
  return testing::sampled({side, side, side}, [&](const Vec3&) { return static_cast<double>(rng.below(2)); });
}

std::vector<CellName> active_cells(const testing::Scene& scene, const CellLevels& cell_levels) {
  std::vector<CellName> cells;
  const Dims& dims = scene.grid.dims();
  cell_levels.append_active_cells(scene.topology.index, {0, 0, 0}, {dims[0], dims[1], dims[2]}, cells);
  return cells;
}

std::size_t lattice_samples(const testing::Scene& scene, const CellLevels& cell_levels) {
  const SampleLattice lattice(scene.surface());
  std::vector<LatticeSample> found;
  for (const auto& [cell, level] : cell_levels.levels()) lattice.append(cell_levels.cell(cell), level, found);
  std::set<std::uint64_t> keys;
  for (const LatticeSample& sample : found) keys.insert(sample.key);
  return keys.size();
}

// Of all cells of noise one level is affordable: that is as many samples as crossings. Of the next two none is, and
// then the lattice itself has more than twice as many.
TEST(SampleBudget, IsThatOfTheLattice) {
  const auto scene = testing::noise_scene({14, 13, 12}, 3);
  CellLevels cell_levels(*scene->isosurface);
  const std::vector<CellName> all = active_cells(*scene, cell_levels);
  std::vector<bool> done(scene->topology.components.size(), false);
  const auto over = [&] { return components_over_budget(scene->surface(), cell_levels, all, done); };
  EXPECT_TRUE(over().empty());
  cell_levels.refine(all);
  EXPECT_EQ(lattice_samples(*scene, cell_levels), scene->topology.crossings.size());
  const std::vector<std::uint32_t> given_up = over();
  ASSERT_EQ(given_up.size(), 1u);  // the large component
  cell_levels.refine(all);
  EXPECT_GT(lattice_samples(*scene, cell_levels), 2 * scene->topology.crossings.size());
  EXPECT_EQ(over(), given_up);
  done[given_up.front()] = true;
  EXPECT_TRUE(over().empty());
}

TEST(SampleBudget, CountsRepeatedCellsOnce) {
  const auto scene = testing::noise_scene({14, 13, 12}, 3);
  const CellLevels cell_levels(*scene->isosurface);
  std::vector<CellName> cells = active_cells(*scene, cell_levels);
  const std::vector<CellName> once = cells;
  for (int i = 0; i < 4; ++i) cells.insert(cells.end(), once.begin(), once.end());
  const std::vector<bool> done(scene->topology.components.size(), false);
  EXPECT_TRUE(components_over_budget(scene->surface(), cell_levels, cells, done).empty());
}

// Without a budget all cells of its large component get level after level.
TEST(SampleBudget, GivesUpMasksEarly) {
  const ScalarGrid grid = random_mask(12, 5);
  MeshingOptions options;
  options.threads = 2;
  const MeshingResult result = mesh_isosurface(grid, 0.5, options);
  EXPECT_LE(result.repair.rounds, 3);
  EXPECT_GE(result.repair.components_given_up, 1);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven);
}

}  // namespace
}  // namespace deliso
