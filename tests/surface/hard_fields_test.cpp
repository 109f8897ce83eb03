// Fields on which meshers lose components, close tunnels or cut themselves: every mesh must have the exact topology.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/mesh_quality.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::sampled_grid;

void expect_homeomorphic(const ScalarGrid& grid, double isovalue, const std::string& name) {
  for (const Boundary boundary : {Boundary::kOpen, Boundary::kClosed}) {
    MeshingOptions options;
    options.parameters.boundary = boundary;
    options.parameters.stage2.r_min = 0.02;
    const MeshingResult result = mesh_isosurface(grid, isovalue, options);
    const std::string run = name + (boundary == Boundary::kOpen ? " open" : " closed");
    EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic) << run;
    EXPECT_EQ(self_intersections(result.mesh).crossing_pairs, 0) << run;
  }
}

TEST(HardFields, Noise) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Rng rng(seed);
    expect_homeomorphic(testing::noise_grid({8, 8, 8}, {1, 1, 1}, rng), 127.5, "seed " + std::to_string(seed));
  }
}

TEST(HardFields, NoiseOfZerosAndOnes) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Rng rng(seed);
    std::vector<std::uint8_t> samples(216);
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(rng.below(2));
    expect_homeomorphic(ScalarGrid({6, 6, 6}, std::move(samples)), 0.5, "seed " + std::to_string(seed));
  }
}

TEST(HardFields, SmallIntegersAtOneOfTheirValues) {
  Rng rng(2);
  std::vector<std::uint8_t> samples(343);
  for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(rng.below(5));
  expect_homeomorphic(ScalarGrid({7, 7, 7}, std::move(samples)), 2, "ties");
}

// A whole number is what people type for a scan. An isovalue a hundredth below left walls and wires as thin, and angles
// below a degree here.
TEST(HardFields, FewIntegersAtOneOfThemLeaveNoNeedles) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    std::vector<std::uint8_t> samples(1728);
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(rng.below(4));
    const MeshingResult result = mesh_isosurface(ScalarGrid({12, 12, 12}, std::move(samples)), 2, {});
    EXPECT_TRUE(is_proven(result.certificate)) << "seed " << seed;
    EXPECT_GE(measure_quality(result.mesh).min_angle_degrees, 5) << "seed " << seed;
  }
}

TEST(HardFields, NoiseTwoSamplesThick) {
  Rng rng(3);
  expect_homeomorphic(testing::noise_grid({14, 14, 2}, {1, 1, 1}, rng), 127.5, "thin");
}

TEST(HardFields, StretchedNoise) {
  Rng rng(4);
  expect_homeomorphic(testing::noise_grid({6, 6, 6}, {1, 1, 4}, rng), 127.5, "stretched");
}

TEST(HardFields, SheetsHalfAVoxelToTwoVoxelsApart) {
  for (const double gap : {0.3, 0.5, 1.0, 2.0}) {
    expect_homeomorphic(sampled_grid<double>({16, 16, 16}, {1, 1, 1},
                                             [&](double i, double j, double k) {
                                               return gap / 2 - std::abs(0.3 * i + 0.5 * j + 0.8124 * k - 12.37);
                                             }),
                        0, "gap " + std::to_string(gap));
  }
}

TEST(HardFields, SurfacesThatTouchTheBox) {
  const auto ball = [](const Vec3& center) {
    return sampled_grid<double>({14, 14, 14}, {1, 1, 1}, [=](double i, double j, double k) {
      return 5 - distance({i, j, k}, center);
    });
  };
  expect_homeomorphic(ball({5, 7.1, 7.2}), 0, "face");
  expect_homeomorphic(ball({5, 5, 7.1}), 0, "edge");
  expect_homeomorphic(ball({0.3, 0.2, 0.1}), 0, "corner");
}

TEST(HardFields, ATorusWithAHoleOfAVoxelAndALoneVoxel) {
  expect_homeomorphic(sampled_grid<double>({22, 22, 14}, {1, 1, 1},
                                           [](double i, double j, double k) {
                                             return 4 - std::hypot(std::hypot(i - 10.6, j - 10.6) - 4.5, k - 6.6);
                                           }),
                      0, "torus");
  expect_homeomorphic(
      sampled_grid<double>({9, 9, 9}, {1, 1, 1},
                           [](double i, double j, double k) { return i == 4 && j == 5 && k == 3 ? 1.0 : -0.3; }),
      0, "voxel");
}

}  // namespace
}  // namespace deliso
