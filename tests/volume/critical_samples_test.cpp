// Critical samples against a small sphere around the sample; sides of saddles against rational arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "volume/critical_points.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

__extension__ typedef __int128 Int128;

// The interpolant of a 3 x 3 x 3 grid at a point given relative to its middle sample.
double value_near_middle(const ScalarGrid& grid, const Vec3& offset) {
  std::array<std::int32_t, 3> cell{};
  Vec3 uvw;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell[axis] = offset[axis] < 0 ? 0 : 1;
    uvw[axis] = offset[axis] < 0 ? 1 + offset[axis] : offset[axis];
  }
  return trilinear_value(grid.cell(cell[0], cell[1], cell[2]), uvw);
}

// Connected parts of a sphere of directions (the surface of a cube of n^3 steps) on which `above` has a given value.
int parts_around_middle(const ScalarGrid& grid, bool above) {
  constexpr int kSteps = 8;
  constexpr double kRadius = 1e-3;
  const int n = kSteps + 1;
  const auto index = [&](int i, int j, int k) { return (k * n + j) * n + i; };
  const auto on_surface = [&](int i, int j, int k) {
    const auto is_end = [&](int x) { return x == 0 || x == kSteps; };
    return i >= 0 && j >= 0 && k >= 0 && i < n && j < n && k < n && (is_end(i) || is_end(j) || is_end(k));
  };
  const double middle = grid.at(1, 1, 1);
  std::vector<bool> open(static_cast<std::size_t>(n * n * n), false);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (!on_surface(i, j, k)) continue;
        const Vec3 d{2.0 * i / kSteps - 1, 2.0 * j / kSteps - 1, 2.0 * k / kSteps - 1};
        const double value = value_near_middle(grid, kRadius / norm(d) * d);
        open[static_cast<std::size_t>(index(i, j, k))] = (value > middle) == above;
      }
    }
  }
  int parts = 0;
  std::vector<std::array<int, 3>> stack;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (!open[static_cast<std::size_t>(index(i, j, k))]) continue;
        ++parts;
        stack.push_back({i, j, k});
        open[static_cast<std::size_t>(index(i, j, k))] = false;
        while (!stack.empty()) {
          const auto [a, b, c] = stack.back();
          stack.pop_back();
          for (int move = 0; move < 6; ++move) {
            const int step = move % 2 * 2 - 1;
            const int x = a + (move / 2 == 0 ? step : 0);
            const int y = b + (move / 2 == 1 ? step : 0);
            const int z = c + (move / 2 == 2 ? step : 0);
            if (!on_surface(x, y, z) || !open[static_cast<std::size_t>(index(x, y, z))]) continue;
            open[static_cast<std::size_t>(index(x, y, z))] = false;
            stack.push_back({x, y, z});
          }
        }
      }
    }
  }
  return parts;
}

TEST(CriticalSamples, HaveASphereAroundThemThatTheirLevelDoesNotCutIntoTwoParts) {
  Rng rng(5);
  int critical = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<float> samples(27);
    // Far apart, so that the sphere's coarse directions see every sign change.
    for (float& sample : samples) sample = static_cast<float>(rng.below(8)) * 10 + 1;
    samples[13] = static_cast<float>(rng.below(8)) * 10 + 6;
    const ScalarGrid grid({3, 3, 3}, std::move(samples));
    const bool expected = parts_around_middle(grid, true) != 1 || parts_around_middle(grid, false) != 1;
    ASSERT_EQ(is_critical_sample(grid, {1, 1, 1}), expected) << "trial " << trial;
    critical += expected ? 1 : 0;
  }
  EXPECT_GT(critical, 20);
}

// A face with integer corners has its saddle at (f0 f2 - f1 f3) / (f0 + f2 - f1 - f3), corners in circular order; the
// double next to that ratio lies on one side of it, which products of 128 bits tell.
TEST(SidesOfSaddles, AreExactNextToTies) {
  Rng rng(11);
  int near_ties = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    CellCorners corners{};
    for (double& corner : corners) corner = static_cast<double>(rng.below(256));
    std::vector<CriticalPoint> saddles;
    append_critical_points(corners, saddles);
    for (const CriticalPoint& saddle : saddles) {
      if (saddle.face < 0) continue;
      const std::size_t axis = static_cast<std::size_t>(saddle.face) / 2;
      const std::size_t base = (static_cast<std::size_t>(saddle.face) % 2) << axis;
      const std::size_t u = 1u << (axis + 1) % 3;
      const std::size_t v = 1u << (axis + 2) % 3;
      const auto f = [&](std::size_t c) { return static_cast<Int128>(corners[base | c]); };
      const Int128 numerator = f(0) * f(u | v) - f(u) * f(v);
      const Int128 denominator = f(0) + f(u | v) - f(u) - f(v);
      const double isovalue = static_cast<double>(numerator) / static_cast<double>(denominator);
      // isovalue = mantissa * 2^-44, exactly, for values below 256.
      const double scaled_isovalue = std::ldexp(isovalue, 44);
      if (scaled_isovalue != std::floor(scaled_isovalue)) continue;
      const Int128 mantissa = static_cast<Int128>(scaled_isovalue);
      Int128 height = (numerator << 44) - mantissa * denominator;
      if (denominator < 0) height = -height;
      const int expected = height > 0 ? 1 : height < 0 ? -1 : 0;
      ASSERT_EQ(side_of_saddle(corners, isovalue, saddle), expected) << "trial " << trial << " isovalue " << isovalue;
      near_ties += expected != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(near_ties, 20);
}

}  // namespace
}  // namespace deliso
