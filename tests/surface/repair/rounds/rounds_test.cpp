// Rounds of repair around given crossings.
#include "surface/repair/rounds/rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
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
    mend();
  }
  void mend() {
    rounds->mend(
        kMostRounds, [] { return false; }, controls);
  }
  [[nodiscard]] AssembledMesh assembled() {
    std::vector<bool> left;
    RepairStats ignored;
    rounds->give_poles();
    return rounds->selection().assemble(left, *scene->isosurface, 1, ignored);
  }
  // Vertices within a voxel and a half of the first of some crossings.
  [[nodiscard]] std::int64_t vertices_near(const std::vector<std::uint32_t>& crossings) {
    const Vec3 place = crossing_position(scene->grid, scene->topology.crossings[crossings.front()]);
    const AssembledMesh all = assembled();
    return std::count_if(all.mesh.points.begin(), all.mesh.points.end(),
                         [&](const Vec3& p) { return distance(p, place) < 1.5; });
  }

  std::unique_ptr<testing::Scene> scene;
  std::unique_ptr<ExactSurfaceCache> cache;
  RepairStats stats;
  Controls controls{{}, nullptr, {}};
  std::unique_ptr<RepairRounds> rounds;
};

// A few crossings of the component with the most crossings.
std::vector<std::uint32_t> some_crossings(const testing::Scene& scene) {
  std::vector<std::int64_t> counts(scene.topology.components.size());
  for (const EdgeCrossing& c : scene.topology.crossings) ++counts[c.component];
  const auto largest = static_cast<std::uint32_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  for (std::uint32_t i = 0; i < scene.topology.crossings.size(); ++i) {
    if (scene.topology.crossings[i].component == largest) return {i};
  }
  return {};
}

TEST(RepairRounds, MendingAroundCrossingsIsARoundOfItsOwn) {
  int finer = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    MendedScene mended(seed);
    if (!mended.rounds->may_go_on(kMostRounds)) continue;
    const std::vector<std::uint32_t> crossings = some_crossings(*mended.scene);
    const std::int64_t vertices = mended.vertices_near(crossings), rounds = mended.stats.rounds;
    mended.rounds->mend_around(crossings, mended.controls);
    EXPECT_EQ(mended.stats.rounds, rounds + 1);
    mended.mend();
    EXPECT_TRUE(mended.rounds->is_done());
    finer += mended.vertices_near(crossings) > vertices ? 1 : 0;
  }
  EXPECT_GE(finer, 2);
}

// Pole heights depend on the signs, and so do the results of the next round.
TEST(RepairRounds, AreTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    MendedScene one(seed, {12, 11, 12}, 1), three(seed, {12, 11, 12}, 3);
    for (int round = 0; round < 2; ++round) {
      ASSERT_TRUE(one.rounds->is_done());
      ASSERT_TRUE(three.rounds->is_done());
      const SurfaceMesh expected = one.rounds->unrepaired_mesh(), found = three.rounds->unrepaired_mesh();
      EXPECT_EQ(found.points, expected.points);
      EXPECT_EQ(found.triangles, expected.triangles);
      EXPECT_EQ(found.pole_heights, expected.pole_heights);
      for (MendedScene* mended : {&one, &three}) {
        mended->rounds->mend_around(some_crossings(*mended->scene), mended->controls);
        mended->mend();
      }
    }
  }
}

TEST(RepairRounds, CrossingsWhereTrianglesMeetAreThoseOfTheirCellAndComponent) {
  MendedScene mended(2);
  const AssembledMesh all = mended.assembled();
  const IsosurfaceTopology& topology = mended.scene->topology;
  EXPECT_TRUE(mended.rounds->crossings_at({}, all.mesh).empty());
  std::size_t found = 0;
  for (std::uint32_t t = 0; t < all.mesh.triangles.size(); t += 7) {
    const auto [a, b, c] = all.mesh.triangles[t];
    const Vec3 middle = (all.mesh.points[a] + all.mesh.points[b] + all.mesh.points[c]) / 3;
    const TrianglePair pair{t, t + 1 < all.mesh.triangles.size() ? t + 1 : 0, TriangleContact::kCrossing, middle};
    // The same pair twice: each crossing once.
    const std::vector<std::uint32_t> crossings =
        mended.rounds->crossings_at(std::vector<TrianglePair>{pair, pair}, all.mesh);
    EXPECT_TRUE(std::is_sorted(crossings.begin(), crossings.end()));
    EXPECT_EQ(std::adjacent_find(crossings.begin(), crossings.end()), crossings.end());
    const auto is_of = [&](std::uint32_t triangle, std::uint32_t component) {
      const auto& corners = all.mesh.triangles[triangle];
      return std::any_of(corners.begin(), corners.end(),
                         [&](std::uint32_t v) { return all.component[v] == component; });
    };
    for (std::uint32_t i = 0; i < topology.crossings.size(); ++i) {
      const Vec3 place = crossing_position(mended.scene->grid, topology.crossings[i]);
      bool expected =
          is_of(pair.first, topology.crossings[i].component) || is_of(pair.second, topology.crossings[i].component);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cell = std::floor(middle[axis]);
        expected = expected && cell <= place[axis] && place[axis] <= cell + 1;
      }
      EXPECT_EQ(std::binary_search(crossings.begin(), crossings.end(), i), expected) << t << " " << i;
    }
    found += crossings.size();
  }
  EXPECT_GT(found, 50U);
}

}  // namespace
}  // namespace deliso
