#include "surface/mesh/mesh_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

constexpr double kPi = 3.141592653589793;

TriangleMesh one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

TEST(MeshQuality, KnowsTheClassicTriangles) {
  const MeshQuality equilateral = measure_quality(one_triangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  EXPECT_NEAR(equilateral.min_angle_degrees, 60, 1e-12);
  EXPECT_NEAR(equilateral.max_angle_degrees, 60, 1e-12);
  EXPECT_NEAR(equilateral.radius_edge_max, 1 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(equilateral.fraction_min_angle_below_30, 0);

  const MeshQuality set_square = measure_quality(one_triangle({0, 0, 0}, {1, 0, 0}, {0, std::sqrt(3.0), 0}));
  EXPECT_NEAR(set_square.min_angle_degrees, 30, 1e-12);
  EXPECT_NEAR(set_square.max_angle_degrees, 90, 1e-12);
  EXPECT_NEAR(set_square.radius_edge_max, 1, 1e-15);
}

// R / l = 1 / (2 sin(smallest angle)), an identity that the code does not use.
TEST(MeshQuality, RadiusEdgeRatioAgreesWithTheSineOfTheSmallestAngle) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const TriangleMesh mesh = testing::random_soup(rng, 3, 0);
    const MeshQuality quality = measure_quality(one_triangle(mesh.points[0], mesh.points[1], mesh.points[2]));
    const double expected = 0.5 / std::sin(quality.min_angle_degrees * kPi / 180);
    EXPECT_NEAR(quality.radius_edge_max / expected, 1, 1e-9) << "triangle " << i;
  }
}

TEST(MeshQuality, IsInvariantUnderScaleToTheEndsOfTheRange) {
  const MeshQuality unit = measure_quality(one_triangle({0, 0, 0}, {1, 0.25, 0}, {0.125, 0.75, 0.5}));
  for (const int exponent : {-1060, -600, 0, 600, 1020}) {
    const double s = std::ldexp(1, exponent);
    const MeshQuality scaled =
        measure_quality(one_triangle({0, 0, 0}, {s, 0.25 * s, 0}, {0.125 * s, 0.75 * s, 0.5 * s}));
    EXPECT_EQ(scaled.min_angle_degrees, unit.min_angle_degrees) << "2^" << exponent;
    EXPECT_EQ(scaled.radius_edge_max, unit.radius_edge_max) << "2^" << exponent;
  }
}

TEST(MeshQuality, SmallAnglesKeepTheirDigits) {
  for (const double height : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const MeshQuality quality = measure_quality(one_triangle({0, 0, 0}, {1, 0, 0}, {0.5, height, 0}));
    const double expected = std::atan(2 * height) * 180 / kPi;
    EXPECT_NEAR(quality.min_angle_degrees / expected, 1, 1e-12) << height;
    EXPECT_NEAR(quality.max_angle_degrees, 180 - 2 * expected, 1e-12);
    EXPECT_EQ(quality.degenerate_triangles, 0);
  }
}

TEST(MeshQuality, DegenerateTrianglesAreFiniteExtremes) {
  const std::vector<TriangleMesh> cases = {one_triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3}),
                                           one_triangle({1, 2, 3}, {1, 2, 3}, {4, 5, 6}),
                                           one_triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3}),
                                           {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}}}};
  for (const TriangleMesh& mesh : cases) {
    const MeshQuality quality = measure_quality(mesh);
    EXPECT_EQ(quality.min_angle_degrees, 0);
    EXPECT_GE(quality.max_angle_degrees, 90);
    EXPECT_EQ(quality.radius_edge_max, kDegenerateRadiusEdge);
    EXPECT_EQ(quality.degenerate_triangles, 1);
    EXPECT_EQ(quality.min_angle_histogram[0], 1);
  }
}

TEST(MeshQuality, StatisticsAgreeWithSortingOneTriangleAtATime) {
  Rng rng(9);
  const TriangleMesh mesh = testing::random_soup(rng, 50, 333);
  const MeshQuality quality = measure_quality(mesh);
  std::vector<double> angles, ratios;
  for (const auto& [a, b, c] : mesh.triangles) {
    const MeshQuality one = measure_quality(one_triangle(mesh.points[a], mesh.points[b], mesh.points[c]));
    angles.push_back(one.min_angle_degrees);
    ratios.push_back(one.radius_edge_max);
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_EQ(quality.radius_edge_max, ratios.back());
  EXPECT_EQ(quality.radius_edge_p99, ratios[329]);  // 330 of 333 are 99.1 %
  EXPECT_NEAR(quality.mean_min_angle_degrees, std::accumulate(angles.begin(), angles.end(), 0.0) / 333, 1e-12);
  for (std::size_t bin = 0; bin < 12; ++bin) {
    const auto in_bin = std::count_if(angles.begin(), angles.end(), [bin](double angle) {
      return angle >= 5.0 * double(bin) && (angle < 5.0 * double(bin + 1) || bin == 11);
    });
    EXPECT_EQ(quality.min_angle_histogram[bin], in_bin) << "bin " << bin;
  }
}

TEST(MeshQuality, TheEmptyMeshHasZeros) {
  const MeshQuality quality = measure_quality({});
  EXPECT_EQ(quality.min_angle_degrees, 0);
  EXPECT_EQ(quality.radius_edge_max, 0);
}

TEST(MeshQuality, IsTheSameForAnyNumberOfThreads) {
  Rng rng(10);
  const TriangleMesh mesh = testing::random_soup(rng, 3000, 70000);
  const MeshQuality one = measure_quality(mesh);
  for (const int threads : {2, 3, 5}) {
    const MeshQuality many = measure_quality(mesh, threads);
    EXPECT_EQ(many.min_angle_degrees, one.min_angle_degrees);
    EXPECT_EQ(many.mean_min_angle_degrees, one.mean_min_angle_degrees);
    EXPECT_EQ(many.max_angle_degrees, one.max_angle_degrees);
    EXPECT_EQ(many.radius_edge_max, one.radius_edge_max);
    EXPECT_EQ(many.radius_edge_p99, one.radius_edge_p99);
    EXPECT_EQ(many.fraction_min_angle_below_30, one.fraction_min_angle_below_30);
    EXPECT_EQ(many.degenerate_triangles, one.degenerate_triangles);
    EXPECT_EQ(many.min_angle_histogram, one.min_angle_histogram);
  }
}

}  // namespace
}  // namespace deliso
