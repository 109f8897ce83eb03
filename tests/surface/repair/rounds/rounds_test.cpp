// Rounds of repair, apart from what comes after them.
#include "surface/repair/rounds/rounds.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

constexpr std::int32_t kMostRounds = 12;

// Rounds that begin with every third crossing of a small noise volume and have repaired all components.
struct MendedScene {
  explicit MendedScene(std::uint64_t seed, const Dims& dims = {8, 8, 7}, int threads = 1)
      : scene(testing::noise_scene(dims, seed)) {
    std::vector<Vec3> points = scene->start();
    const std::vector<Vec3> crossings = testing::crossing_points(*scene);
    for (std::size_t i = 0; i < crossings.size(); i += 3) points.push_back(crossings[i]);
    cache = std::make_unique<ExactSurfaceCache>(scene->surface(threads));
    rounds = std::make_unique<RepairRounds>(
        *cache, std::make_unique<SignedDelaunay>(*scene->isosurface, points, threads), stats);
    rounds->mend(
        kMostRounds, [] { return false; }, controls);
  }
  std::unique_ptr<testing::Scene> scene;
  std::unique_ptr<ExactSurfaceCache> cache;
  RepairStats stats;
  Controls controls{{}, nullptr, {}};
  std::unique_ptr<RepairRounds> rounds;
};

// Pole heights depend on the signs, and so do the results of the next round.
TEST(RepairRounds, AreTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    MendedScene one(seed, {12, 11, 12}, 1), three(seed, {12, 11, 12}, 3);
    ASSERT_TRUE(one.rounds->selection().is_done());
    ASSERT_TRUE(three.rounds->selection().is_done());
    EXPECT_GT(one.stats.rounds, 0);
    const SurfaceMesh expected = one.rounds->unrepaired_mesh(), found = three.rounds->unrepaired_mesh();
    EXPECT_EQ(found.points, expected.points);
    EXPECT_EQ(found.triangles, expected.triangles);
    EXPECT_EQ(found.pole_heights, expected.pole_heights);
  }
}

}  // namespace
}  // namespace deliso
