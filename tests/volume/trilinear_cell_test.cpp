// The trilinear interpolant against its polynomial in exact integers, and what neighbouring cells share.
#include "volume/trilinear_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

constexpr int kCases = 2000;

CellCorners random_corners(Rng& rng) {
  CellCorners corners{};
  for (double& c : corners) c = static_cast<double>(rng.below(65536)) - 32768;
  return corners;
}

// A point whose coordinates are multiples of 1/256, often on faces, edges and corners.
Vec3 random_point(Rng& rng) {
  const auto coordinate = [&rng] {
    const std::uint64_t n = rng.below(320);
    return static_cast<double>(n > 256 ? (n % 2) * 256 : n) / 256;
  };
  const double u = coordinate();
  const double v = coordinate();
  return {u, v, coordinate()};
}

// 2^24 times the interpolant's value by the definition, in integers: the corners weighted with opposite volumes.
std::int64_t exact_value(const CellCorners& corners, const Vec3& uvw) {
  std::int64_t sum = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    auto weight = static_cast<std::int64_t>(corners[n]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto t = static_cast<std::int64_t>(uvw[axis] * 256);
      weight *= (n >> axis & 1) != 0 ? t : 256 - t;
    }
    sum += weight;
  }
  return sum;
}

TEST(TrilinearCell, ValueIsTheDefinitionExactly) {
  // 16-bit samples and parameters of 8 bits: every step is exact in doubles.
  Rng rng(1);
  for (int n = 0; n < kCases; ++n) {
    const CellCorners corners = random_corners(rng);
    const Vec3 p = random_point(rng);
    EXPECT_EQ(trilinear_value(corners, p) * 0x1p24, static_cast<double>(exact_value(corners, p)));
  }
}

TEST(TrilinearCell, GradientIsTheDifferenceQuotientExactly) {
  // Along each axis the interpolant is linear, so the difference across the whole cell is the derivative.
  Rng rng(2);
  for (int n = 0; n < kCases; ++n) {
    const CellCorners corners = random_corners(rng);
    const Vec3 p = random_point(rng);
    const Vec3 gradient = trilinear_gradient(corners, p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 low = p;
      Vec3 high = p;
      low[axis] = 0;
      high[axis] = 1;
      EXPECT_EQ(gradient[axis] * 0x1p24, static_cast<double>(exact_value(corners, high) - exact_value(corners, low)));
    }
  }
}

TEST(TrilinearCell, CoefficientsAreThoseOfThePolynomial) {
  Rng rng(3);
  for (int n = 0; n < kCases; ++n) {
    const CellCorners corners = random_corners(rng);
    const CellCorners c = trilinear_coefficients(corners);
    const Vec3 p = random_point(rng);
    const double value = c[0] + c[1] * p.x + c[2] * p.y + c[3] * p.x * p.y + c[4] * p.z + c[5] * p.x * p.z +
                         c[6] * p.y * p.z + c[7] * p.x * p.y * p.z;
    EXPECT_EQ(value, trilinear_value(corners, p));
  }
}

TEST(TrilinearCell, ValuesAreCloseToTheDefinitionAtArbitraryPoints) {
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    Rng rng(seed);
    const CellCorners corners = random_corners(rng);
    const Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
    long double sum = 0;
    for (std::size_t n = 0; n < 8; ++n) {
      long double weight = corners[n];
      for (std::size_t axis = 0; axis < 3; ++axis) weight *= (n >> axis & 1) != 0 ? p[axis] : 1.0L - p[axis];
      sum += weight;
    }
    EXPECT_NEAR(trilinear_value(corners, p), static_cast<double>(sum), 32768 * 0x1p-50) << "seed " << seed;
  }
}

TEST(TrilinearCell, SharedFacesGiveTheSameBitsFromBothCells) {
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    Rng rng(seed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The upper face of the first cell is the lower face of the second. Samples are arbitrary doubles here.
      CellCorners first{};
      CellCorners second{};
      for (double& c : first) c = rng.uniform(-1, 1) * std::pow(10.0, rng.uniform(-12, 12));
      for (double& c : second) c = rng.uniform(-1, 1);
      const std::size_t bit = std::size_t{1} << axis;
      for (std::size_t n = 0; n < 8; ++n)
        if ((n & bit) == 0) second[n] = first[n | bit];
      Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
      p[axis] = 1;
      Vec3 q = p;
      q[axis] = 0;
      EXPECT_EQ(trilinear_value(first, p), trilinear_value(second, q)) << "seed " << seed << " axis " << axis;
      const Vec3 g = trilinear_gradient(first, p);
      const Vec3 h = trilinear_gradient(second, q);
      for (const std::size_t along : {(axis + 1) % 3, (axis + 2) % 3})
        EXPECT_EQ(g[along], h[along]) << "seed " << seed << " axis " << axis;
    }
  }
}

TEST(TrilinearCell, CornersGiveTheSamples) {
  Rng rng(4);
  CellCorners corners{};
  for (double& c : corners) c = rng.uniform(-1e9, 1e-9);
  for (std::size_t n = 0; n < 8; ++n) {
    const Vec3 p{static_cast<double>(n & 1), static_cast<double>(n >> 1 & 1), static_cast<double>(n >> 2)};
    EXPECT_EQ(trilinear_value(corners, p), corners[n]);
  }
}

TEST(TrilinearCell, ValuesStayInTheRangeOfIntegerCornersAndConstantCellsAreConstant) {
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    Rng rng(seed);
    CellCorners corners{};
    for (double& c : corners) c = static_cast<double>(rng.below(3));
    const Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
    const double value = trilinear_value(corners, p);
    EXPECT_GE(value, *std::min_element(corners.begin(), corners.end())) << "seed " << seed;
    EXPECT_LE(value, *std::max_element(corners.begin(), corners.end())) << "seed " << seed;
    corners.fill(corners[0] + 0.1);
    EXPECT_EQ(trilinear_value(corners, p), corners[0]) << "seed " << seed;
    EXPECT_EQ(trilinear_gradient(corners, p), (Vec3{0, 0, 0})) << "seed " << seed;
  }
}

}  // namespace
}  // namespace deliso
