// Smoothing against the sum by its definition, and what must not change it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "volume/filters/gaussian.h"

namespace deliso {
namespace {

template <class Sample>
ScalarGrid random_samples(const Dims& dims, Rng& rng, double scale) {
  std::vector<Sample> samples(checked_sample_count(dims));
  for (Sample& sample : samples) sample = static_cast<Sample>(scale * static_cast<double>(rng.below(256)));
  return {dims, std::move(samples)};
}

// The whole sum at one sample: over all samples within four sigmas along each axis, those beyond the box being those
// at its faces, over the sum of all weights.
double convolved(const ScalarGrid& grid, const Vec3& sigma, const std::array<int, 3>& at) {
  std::array<int, 3> reach{};
  for (std::size_t a = 0; a < 3; ++a) reach[a] = sigma[a] > 0 ? std::max(1, int(std::ceil(4 * sigma[a]))) : 0;
  const auto exponent = [&](std::size_t a, int d) {
    return sigma[a] > 0 ? -double(d) * d / (2 * sigma[a] * sigma[a]) : 0.0;
  };
  const auto inside = [&](std::size_t a, int d) { return std::clamp(at[a] + d, 0, grid.dims()[a] - 1); };
  double sum = 0, weights = 0;
  for (int x = -reach[0]; x <= reach[0]; ++x) {
    for (int y = -reach[1]; y <= reach[1]; ++y) {
      for (int z = -reach[2]; z <= reach[2]; ++z) {
        const double weight = std::exp(exponent(0, x) + exponent(1, y) + exponent(2, z));
        weights += weight;
        sum += weight * grid.at(inside(0, x), inside(1, y), inside(2, z));
      }
    }
  }
  return sum / weights;
}

void expect_convolved(const ScalarGrid& grid, const Vec3& sigma, double tolerance) {
  const ScalarGrid result = smoothed(grid, sigma, 2);
  ASSERT_EQ(result.dims(), grid.dims());
  for (int k = 0; k < grid.dims()[2]; ++k) {
    for (int j = 0; j < grid.dims()[1]; ++j) {
      for (int i = 0; i < grid.dims()[0]; ++i) {
        ASSERT_NEAR(result.at(i, j, k), convolved(grid, sigma, {i, j, k}), tolerance) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

TEST(Gaussian, IsTheSumByItsDefinition) {
  Rng rng(1);
  expect_convolved(random_samples<std::uint8_t>({9, 7, 8}, rng, 1), {1, 1, 1}, 1e-5 * 255);
  expect_convolved(random_samples<double>({7, 6, 11}, rng, 1e9), {0.7, 1.3, 2}, 1e-12 * 255e9);
  expect_convolved(random_samples<std::int32_t>({5, 4, 6}, rng, 1e6), {0.4, 0, 3}, 1e-12 * 255e6);
  expect_convolved(random_samples<float>({2, 3, 40}, rng, 0.01), {5, 0.3, 1.5}, 1e-5 * 2.55);
}

TEST(Gaussian, IsTheSameToTheLastBitForAnyNumberOfThreads) {
  Rng rng(2);
  for (const Vec3& sigma : {Vec3{1, 1, 1}, Vec3{2.5, 0.5, 6}}) {
    const ScalarGrid grid = random_samples<double>({13, 11, 97}, rng, 0.1);
    const ScalarGrid one = smoothed(grid, sigma, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(smoothed(grid, sigma, threads).samples(), one.samples());
  }
}

TEST(Gaussian, OfAReflectedVolumeIsTheReflectedOne) {
  Rng rng(3);
  const ScalarGrid grid = random_samples<double>({9, 10, 11}, rng, 0.1);
  const auto reflected = [](const ScalarGrid& g) {
    std::vector<double> samples(g.sample_count());
    const auto [nx, ny, nz] = g.dims();
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) samples[g.index(i, j, k)] = g.at(nx - 1 - i, ny - 1 - j, nz - 1 - k);
    return ScalarGrid(g.dims(), std::move(samples));
  };
  const Vec3 sigma{1.1, 0.9, 1.7};
  EXPECT_EQ(smoothed(reflected(grid), sigma, 2).samples(), reflected(smoothed(grid, sigma, 2)).samples());
}

// A mask that is its own complement when it is turned around: on its middle plane the sums are equal but for their
// order. Rounding must not decide.
TEST(Gaussian, LeavesNoNoiseWhereAMaskIsSymmetric) {
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i) samples.push_back(i < 4 ? 0 : i > 4 ? 2 : 1);
  const ScalarGrid result = smoothed(ScalarGrid({9, 9, 9}, std::move(samples)), {1.3, 1.3, 1.3}, 1);
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j) EXPECT_EQ(result.at(4, j, k), 1) << j << ' ' << k;
}

TEST(Gaussian, KeepsConstantsAndTakesLengthsInSpacings) {
  const ScalarGrid flat({3, 4, 5}, std::vector<std::int16_t>(60, -7));
  EXPECT_EQ(smoothed(flat, {1, 2, 3}, 1).range(), std::pair(-7.0, -7.0));
  EXPECT_EQ(sigma_in_spacings(2, {0.5, 1, 4}), (Vec3{2, 1, 0.25}));
  EXPECT_THROW(smoothed(flat, {1, -1, 1}, 1), InputError);
  EXPECT_THROW(smoothed(flat, {1, 1, 1e9}, 1), InputError);
}

}  // namespace
}  // namespace deliso
