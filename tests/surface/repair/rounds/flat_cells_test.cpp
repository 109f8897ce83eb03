// Cells much longer than wide, as of scans in thick slices: repair has its samples between the slices, too.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/verification/verification.h"

namespace deliso {
namespace {

constexpr std::int32_t kSide = 10;

std::vector<double> noise(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> samples;
  for (std::int32_t i = 0; i < kSide * kSide * kSide; ++i) samples.push_back(rng.uniform());
  return samples;
}

// The means of samples and the next ones along each axis, around the ends, so often.
std::vector<double> smoothed(std::vector<double> samples, int times) {
  for (int i = 0; i < times; ++i) {
    for (const std::size_t next : {std::size_t{1}, std::size_t{kSide}, std::size_t{kSide} * kSide}) {
      std::vector<double> means;
      for (std::size_t s = 0; s < samples.size(); ++s) {
        means.push_back((samples[s] + samples[(s + next) % samples.size()]) / 2);
      }
      samples = std::move(means);
    }
  }
  return samples;
}

// Needles of marching cubes in such cells would be a third of the triangles that the last stage gets.
void expect_proven_without_needles(const ScalarGrid& grid, bool is_given_up) {
  MeshingOptions options;
  options.threads = 2;
  const MeshingResult result = mesh_isosurface(grid, 0.5, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven);
  EXPECT_EQ(result.repair.components_polygonized > 0, is_given_up);
  EXPECT_LT(result.shape.bad_before, std::ssize(result.mesh.triangles) / 30);
}

TEST(FlatCells, OfASmoothFieldAreRepairedByTheLattice) {
  for (std::uint64_t seed = 1; seed < 3; ++seed)
    expect_proven_without_needles({{kSide, kSide, kSide}, smoothed(noise(seed), 3), {1, 1, 6}}, false);
}

// Where the mesh has a thin slit on the box in two parts, Euler curves often part elsewhere or not at all: without a
// look at the box these fields take 3, 2 and 2 rounds.
TEST(FlatCells, AreLookedAtOnTheBoxWhereLoopsAreWrong) {
  std::int64_t rounds = 0;
  for (const std::uint64_t seed : {10u, 18u, 23u}) {
    const MeshingResult result = mesh_isosurface({{kSide, kSide, kSide}, smoothed(noise(seed), 3), {1, 1, 6}}, 0.5, {});
    EXPECT_TRUE(is_proven(result.certificate));
    rounds += result.repair.rounds;
  }
  EXPECT_LE(rounds, 4);
}

TEST(FlatCells, OfNoiseAreTakenFromFinerCubes) {
  expect_proven_without_needles({{kSide, kSide, kSide}, noise(2), {1, 1, 6}}, true);
}

}  // namespace
}  // namespace deliso
