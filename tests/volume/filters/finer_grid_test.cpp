#include "volume/filters/finer_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "volume/topology/crossing_index.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

ScalarGrid random_grid(const Dims& dims, Rng& rng) {
  std::vector<double> samples;
  for (std::int32_t i = 0; i < dims[0] * dims[1] * dims[2]; ++i) samples.push_back(rng.uniform());
  return {dims, std::move(samples)};
}

TEST(FinerGrid, HasTheSameSamplesAndTheSameInterpolant) {
  constexpr std::array<std::int32_t, 3> kTimes = {3, 1, 4};
  Rng rng(1);
  const ScalarGrid grid = random_grid({6, 5, 4}, rng);
  const SamplePart part{{2, 1, 0}, {3, 4, 4}};
  const std::optional<ScalarGrid> finer = finer_grid(grid, part, kTimes, 1000);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->dims(), (Dims{7, 4, 13}));
  for (std::int32_t k = 0; k < 4; ++k) {
    for (std::int32_t j = 0; j < 4; ++j) {
      for (std::int32_t i = 0; i < 3; ++i) EXPECT_EQ(finer->at(3 * i, j, 4 * k), grid.at(2 + i, 1 + j, k));
    }
  }
  // A point of a finer cell, and the same point of the cell that holds it.
  for (int trial = 0; trial < 200; ++trial) {
    CellIndex cell{}, fine{};
    Vec3 in_cell, in_fine;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto steps = static_cast<std::uint64_t>((part.dims[axis] - 1) * kTimes[axis]);
      fine[axis] = static_cast<std::int32_t>(rng.below(steps));
      in_fine[axis] = rng.uniform();
      cell[axis] = part.low[axis] + fine[axis] / kTimes[axis];
      in_cell[axis] = (fine[axis] % kTimes[axis] + in_fine[axis]) / kTimes[axis];
    }
    EXPECT_NEAR(trilinear_value(finer->cell(fine[0], fine[1], fine[2]), in_fine),
                trilinear_value(grid.cell(cell[0], cell[1], cell[2]), in_cell), 1e-14);
  }
}

TEST(FinerGrid, IsNothingWhereItWouldBeTooLarge) {
  Rng rng(2);
  const ScalarGrid grid = random_grid({3, 3, 3}, rng);
  EXPECT_TRUE(finer_grid(grid, {{0, 0, 0}, {3, 3, 3}}, {2, 2, 2}, 125));
  EXPECT_FALSE(finer_grid(grid, {{0, 0, 0}, {3, 3, 3}}, {2, 2, 2}, 124));
  EXPECT_FALSE(finer_grid(grid, {{0, 0, 0}, {3, 3, 3}}, {1 << 30, 1 << 30, 1 << 30}, 124));
}

}  // namespace
}  // namespace deliso
