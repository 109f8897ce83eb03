// Components that repair gives up: what they have to spend, and what becomes of them.
#include "surface/repair/rounds/sample_budget.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

ScalarGrid random_mask(int side, std::uint64_t seed) {
  Rng rng(seed);
  return testing::sampled({side, side, side}, [&](const Vec3&) { return static_cast<double>(rng.below(2)); });
}

// A component of noise, and many small ones, each with `share` samples for each of its crossings.
std::vector<std::uint32_t> samples_of_components(const IsosurfaceTopology& topology, double share) {
  std::vector<std::uint32_t> component_of_sample;
  double owed = 0;
  for (const EdgeCrossing& crossing : topology.crossings) {
    for (owed += share; owed >= 1; owed -= 1) component_of_sample.push_back(crossing.component);
  }
  component_of_sample.push_back(kNoComponent);
  return component_of_sample;
}

// The number of rounds that the components have.
int rounds_with(const testing::Scene& scene, double share) {
  SampleBudget budget(scene.surface());
  const std::vector<bool> done(scene.topology.components.size(), false);
  const std::vector<std::uint32_t> samples = samples_of_components(scene.topology, share);
  for (int rounds = 0; rounds < 20; ++rounds) {
    if (!budget.spend(samples, done).empty()) return rounds;
  }
  return 20;
}

TEST(SampleBudget, LastsLongerTheFewerSamplesThereAre) {
  const auto scene = testing::noise_scene({20, 20, 20}, 3);
  EXPECT_EQ(rounds_with(*scene, 2.5), 0);
  EXPECT_EQ(rounds_with(*scene, 1.25), 1);
  EXPECT_EQ(rounds_with(*scene, 0.8), 2);
  EXPECT_EQ(rounds_with(*scene, 0.25), 9);
}

// What is granted beyond that is for all together, so thousands of tiny components do not have it each.
TEST(SampleBudget, GrantsMoreOnce) {
  const auto scene = testing::noise_scene({20, 20, 20}, 3);
  const std::size_t count = scene->topology.components.size();
  ASSERT_GT(count, 30u);
  const std::vector<bool> done(count, false);
  std::vector<std::uint32_t> samples(5000, 7), of_all;
  std::vector<std::int64_t> crossings(count, 0);
  for (const EdgeCrossing& crossing : scene->topology.crossings) ++crossings[crossing.component];
  ASSERT_LT(crossings[7], 100);
  EXPECT_EQ(SampleBudget(scene->surface()).spend(samples, done), std::vector<std::uint32_t>{7});
  samples.resize(3000);
  EXPECT_TRUE(SampleBudget(scene->surface()).spend(samples, done).empty());
  std::vector<std::uint32_t> tiny;  // each has two hundred samples more than it would have to itself
  for (std::uint32_t c = 0; c < count; ++c) {
    if (crossings[c] > 100) continue;
    tiny.push_back(c);
    of_all.insert(of_all.end(), static_cast<std::size_t>(3 * crossings[c] + 200), c);
  }
  EXPECT_EQ(SampleBudget(scene->surface()).spend(of_all, done), tiny);
}

TEST(SampleBudget, IsOfNoInterestOnceAComponentIsDone) {
  const auto scene = testing::noise_scene({20, 20, 20}, 3);
  SampleBudget budget(scene->surface());
  const std::vector<bool> done(scene->topology.components.size(), true);
  EXPECT_TRUE(budget.spend(samples_of_components(scene->topology, 3), done).empty());
}

// Marching cubes would take a grid of five layers for each layer of these cells: five times as many crossings of the
// edges along x and y. So the component has more rounds.
TEST(SampleBudget, CountsTheCrossingsOfTheFinerGridInFlatCells) {
  const auto cubes = testing::noise_scene({20, 20, 20}, 3);
  const auto flat = testing::noise_scene({20, 20, 20}, 3, {1, 1, 5});
  EXPECT_EQ(rounds_with(*cubes, 2.5), 0);
  EXPECT_GE(rounds_with(*flat, 2.5), 2);
}

// With all its rounds the large component gets a lattice of many more samples, and comes from marching cubes, too.
TEST(SampleBudget, GivesUpMasksEarly) {
  const ScalarGrid grid = random_mask(16, 5);
  MeshingOptions options;
  options.threads = 2;
  const MeshingResult result = mesh_isosurface(grid, 0.5, options);
  EXPECT_LE(result.repair.rounds, 2);
  EXPECT_GE(result.repair.components_given_up, 1);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven);
}

}  // namespace
}  // namespace deliso
