// The criteria of both stages: what each of them holds for, and which of them counts.
#include "surface/base/criteria.h"

#include <gtest/gtest.h>

#include <limits>

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The paper's thresholds of stage 2.
constexpr Criteria kLimit = {.epsilon = 0.1, .rho = 2, .r_min = 0.01, .epsilon2 = 0.2};
// A triangle that meets them all.
constexpr TriangleMeasures kFine = {.h = 0.05, .r = 1, .l = 1.7, .h_mean = 10};

TEST(Criteria, EachHoldsBeyondItsThreshold) {
  TriangleMeasures sigma = kFine;
  sigma.h = 0.11;  // h / r > 0.1
  EXPECT_NEAR(badness1(sigma, kLimit), 1.1, 1e-15);
  sigma = kFine;
  sigma.h_mean = 4;  // r / h_mean > 0.2
  EXPECT_NEAR(badness2(sigma, kLimit), 1.25, 1e-15);
  sigma = kFine;
  sigma.l = 0.4;  // r / l > 2
  EXPECT_NEAR(badness3(sigma, kLimit), 1.25, 1e-15);
  EXPECT_FALSE(exceeds_r_min(0.01, kLimit));
  EXPECT_TRUE(exceeds_r_min(0.010001, kLimit));
  Criteria near = kLimit;
  near.max_distance = 0.04;
  EXPECT_NEAR(distance_badness(kFine, near), 1.25, 1e-15);
  EXPECT_EQ(distance_badness(kFine, kLimit), 0);
}

TEST(Criteria, Criterion2MayCompareTheShortestEdge) {
  Criteria by_edge = kLimit;
  by_edge.criterion2 = Criterion2::kShortestEdge;
  EXPECT_NEAR(badness2(kFine, kLimit), 0.5, 1e-15);
  EXPECT_NEAR(badness2(kFine, by_edge), 0.85, 1e-15);
}

TEST(Criteria, BadnessIsThatOfTheWorstCriterion) {
  EXPECT_NEAR(refine_geometry_badness(kFine, kLimit), 0.5, 1e-15);
  TriangleMeasures sigma = kFine;
  sigma.h_mean = 4;
  EXPECT_NEAR(refine_geometry_badness(sigma, kLimit), 1.25, 1e-15);
  sigma.l = 0.25;
  EXPECT_NEAR(refine_geometry_badness(sigma, kLimit), 2, 1e-15);
  sigma.h = 0.3;
  EXPECT_NEAR(refine_geometry_badness(sigma, kLimit), 3, 1e-15);
  Criteria near = kLimit;
  near.max_distance = 0.06;
  EXPECT_NEAR(refine_geometry_badness(sigma, near), 5, 1e-15);
}

TEST(Criteria, ApproximateGeomDoesNotAskForPoleHeights) {
  TriangleMeasures sigma = kFine;
  for (const double h_mean : {0.0, 1e-9, kInfinity}) {
    sigma.h_mean = h_mean;
    EXPECT_NEAR(approximate_geometry_badness(sigma, kLimit), 0.5, 1e-15);
  }
  sigma.h_mean = 0;
  EXPECT_EQ(refine_geometry_badness(sigma, kLimit), kInfinity);
  // Without a threshold it does not count, whatever the pole heights are.
  Criteria without = kLimit;
  without.epsilon2 = kInfinity;
  EXPECT_NEAR(refine_geometry_badness(sigma, without), 0.5, 1e-15);
}

}  // namespace
}  // namespace deliso
