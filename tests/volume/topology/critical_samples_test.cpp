// Critical samples against a small sphere around the sample; sides of saddles against rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "volume/topology/critical_points.h"
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
    for (int corner = 0; corner < 8; ++corner) {  // of the cells around it
      const unsigned corners = critical_corners(grid, {1 - (corner & 1), 1 - (corner >> 1 & 1), 1 - (corner >> 2)});
      ASSERT_EQ((corners >> corner & 1u) != 0, expected) << "trial " << trial << ", corner " << corner;
    }
    critical += expected ? 1 : 0;
  }
  EXPECT_GT(critical, 20);
}

// Whether a sample is critical, from its neighbours one by one; higher index wins ties.
bool is_critical(const ScalarGrid& grid, const std::array<std::int32_t, 3>& sample) {
  const auto rank = [&](const std::array<std::int32_t, 3>& s) {
    return std::make_pair(grid.at(s[0], s[1], s[2]), grid.index(s[0], s[1], s[2]));
  };
  std::array<std::vector<std::array<int, 3>>, 2> sides;  // directions of the neighbours below and above
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      std::array<std::int32_t, 3> at = sample;
      at[axis] += step;
      if (at[axis] < 0 || at[axis] >= grid.dims()[axis]) continue;
      std::array<int, 3> direction{};
      direction[axis] = step;
      sides[rank(at) > rank(sample) ? 1 : 0].push_back(direction);
    }
  }
  return std::any_of(sides.begin(), sides.end(), [](const auto& side) {
    return side.empty() ||
           (side.size() == 2 && side[0][0] == -side[1][0] && side[0][1] == -side[1][1] && side[0][2] == -side[1][2]);
  });
}

TEST(CriticalSamples, AreToldByTheirNeighboursAlsoOnTheBorderAndWithTies) {
  for (const Dims& dims : {Dims{6, 5, 4}, Dims{2, 2, 2}, Dims{2, 7, 3}}) {
    Rng rng(17);
    std::vector<std::uint8_t> samples(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(rng.below(4));
    const ScalarGrid grid(dims, std::move(samples));
    int critical = 0;
    for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
      for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
        for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
          const unsigned corners = critical_corners(grid, {i, j, k});
          for (int c = 0; c < 8; ++c) {
            const bool expected = is_critical(grid, {i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)});
            ASSERT_EQ((corners >> c & 1) != 0, expected) << i << " " << j << " " << k << " corner " << c;
            critical += expected ? 1 : 0;
          }
        }
      }
    }
    EXPECT_GT(critical, 0);
  }
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
