// Criteria 1 and 2 of stage 2 lapse at or below h_min for triangles no larger than a voxel, and count as in the paper
// for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "delaunay/base/rng.h"
#include "surface/base/criteria.h"
#include "surface/base/sizes.h"

namespace deliso {
namespace {

Criteria limits_of_the_paper(Rng& rng) {
  Criteria limit{.epsilon = rng.uniform(0.05, 0.5), .rho = rng.uniform(1, 3), .epsilon2 = rng.uniform(0.05, 0.5)};
  if (rng.below(3) == 0) limit.max_distance = rng.uniform(0.05, 0.5);
  return limit;
}

TriangleMeasures any_triangle(Rng& rng) {
  const double r = rng.uniform(0.1, 3);
  return {.h = rng.below(8) == 0 ? 0 : rng.uniform(0, 0.6),
          .r = r,
          .l = rng.uniform(0.1, 1.7) * r,
          .h_mean = rng.uniform(0.1, 9)};
}

// The paper's criteria, and a bound on h, each by itself.
bool is_coarse(const TriangleMeasures& sigma, const Criteria& limit) {
  const bool has_lapsed = sigma.h <= limit.h_min && sigma.r <= 1 && limit.h_min > 0;
  return (!has_lapsed && (sigma.h > limit.epsilon * sigma.r || sigma.r > limit.epsilon2 * sigma.h_mean)) ||
         sigma.r > limit.rho * sigma.l || sigma.h > limit.max_distance;
}

TEST(LapsedCriteria, OneAndTwoAskForNothingAtOrBelowHMin) {
  Rng rng(1);
  int lapsed = 0, coarse = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Criteria limit = limits_of_the_paper(rng);
    const TriangleMeasures sigma = any_triangle(rng);
    const bool before = is_coarse(sigma, limit);
    limit.h_min = rng.uniform(0.01, 0.5);
    ASSERT_EQ(refine_geometry_badness(sigma, limit) > 1, is_coarse(sigma, limit)) << trial;
    coarse += is_coarse(sigma, limit) ? 1 : 0;
    lapsed += before && !is_coarse(sigma, limit) ? 1 : 0;
  }
  EXPECT_GT(lapsed, 500);
  EXPECT_GT(coarse, 1000);
}

TEST(LapsedCriteria, WithoutHMinBadnessIsThePapersToTheLastBit) {
  Rng rng(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const Criteria limit = limits_of_the_paper(rng);
    const TriangleMeasures sigma = any_triangle(rng);
    const double expected = std::max({sigma.h / (sigma.r * limit.epsilon), sigma.r / (sigma.h_mean * limit.epsilon2),
                                      sigma.r / (sigma.l * limit.rho), sigma.h / limit.max_distance});
    ASSERT_EQ(std::bit_cast<std::uint64_t>(refine_geometry_badness(sigma, limit)),
              std::bit_cast<std::uint64_t>(expected))
        << trial;
  }
}

// Stage 1 has criteria of its own, which nothing takes back.
TEST(LapsedCriteria, Stage1DoesNotAskForHMin) {
  const Criteria limit{.epsilon = 0.1, .rho = 2, .h_min = 1};
  EXPECT_NEAR(approximate_geometry_badness({.h = 0.5, .r = 1, .l = 1.7, .h_mean = 1}, limit), 5, 1e-12);
  EXPECT_EQ(refine_geometry_badness({.h = 0.5, .r = 0.25, .l = 0.4, .h_mean = 1}, limit), 0.5);  // h over h_min
  EXPECT_EQ(refine_geometry_badness({.h = 0.5, .r = 1.5, .l = 2, .h_mean = 1}, limit), 1.5);     // r over a voxel
}

// Fine thresholds must not lapse at the height that is usual at the paper's.
TEST(LapsedCriteria, UsualHMinFollowsTheThresholds) {
  Parameters parameters;
  const double usual = effective_h_min(parameters);
  EXPECT_GT(usual, 0);
  parameters.stage2.epsilon1 /= 2;
  EXPECT_DOUBLE_EQ(effective_h_min(parameters), usual / 4);
  parameters.stage2.epsilon2 /= 10;
  EXPECT_DOUBLE_EQ(effective_h_min(parameters), usual / 100);
  parameters.stage2 = {};
  parameters.stage2.epsilon1 *= 2;
  EXPECT_EQ(effective_h_min(parameters), usual);
  parameters.stage2.rho = 1.5;
  EXPECT_EQ(effective_h_min(parameters), 0);
  parameters.stage2.h_min = 0.04;
  EXPECT_EQ(effective_h_min(parameters), 0.04);
  parameters.size.max_error = 0.1;
  EXPECT_EQ(effective_h_min(parameters), 0);
}

}  // namespace
}  // namespace deliso
