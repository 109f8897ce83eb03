#include "raycast/cubic_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

using Solver = SignChanges (*)(const BernsteinCubic&);

long double value_at(const BernsteinCubic& b, long double t) {
  const long double s = 1 - t;
  return b[0] * s * s * s + 3 * b[1] * t * s * s + 3 * b[2] * t * t * s + b[3] * t * t * t;
}

// Bernstein form of (t - r0)(t - r1)(t - r2) * scale, by its blossom.
BernsteinCubic cubic_with_roots(double r0, double r1, double r2, double scale) {
  const auto blossom = [&](double x, double y, double z) {
    double sum = 0;
    const double r[3] = {r0, r1, r2};
    const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& o : order) sum += (x - r[o[0]]) * (y - r[o[1]]) * (z - r[o[2]]);
    return scale * sum / 6;
  };
  return {blossom(0, 0, 0), blossom(0, 0, 1), blossom(0, 1, 1), blossom(1, 1, 1)};
}

class BothSolvers : public ::testing::TestWithParam<Solver> {};
INSTANTIATE_TEST_SUITE_P(CubicSolver, BothSolvers, ::testing::Values(bracketed_sign_changes, schwarze_sign_changes));

TEST_P(BothSolvers, FindTheWellSeparatedRootsThatACubicWasMadeFrom) {
  Rng rng(1);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<double> roots(3);
    for (double& root : roots) root = rng.uniform(-1, 2);
    std::sort(roots.begin(), roots.end());
    if (roots[1] - roots[0] < 1e-2 || roots[2] - roots[1] < 1e-2) continue;
    if (std::any_of(roots.begin(), roots.end(), [](double r) { return std::abs(r) < 1e-6 || std::abs(r - 1) < 1e-6; }))
      continue;
    const SignChanges found = GetParam()(cubic_with_roots(roots[0], roots[1], roots[2], rng.uniform(-50, 50)));
    std::erase_if(roots, [](double r) { return r < 0 || r > 1; });
    ASSERT_EQ(found.count, static_cast<int>(roots.size())) << "trial " << trial;
    for (std::size_t i = 0; i < roots.size(); ++i) ASSERT_NEAR(found.at[i], roots[i], 1e-10) << "trial " << trial;
  }
}

TEST_P(BothSolvers, CountIsOddExactlyWhenTheEndsDifferWhateverTheCubic) {
  Rng rng(2);
  for (int trial = 0; trial < 200000; ++trial) {
    BernsteinCubic b;
    for (double& value : b) {
      value = rng.uniform(-1, 1);
      const auto kind = rng.below(12);
      if (kind == 0) value = 0;
      if (kind == 1) value = -0.0;
      if (kind == 2) value *= 1e-16;
      if (kind == 3) value = b[0];
      if (kind == 4) value *= 1e200;
    }
    const SignChanges found = GetParam()(b);
    ASSERT_EQ(found.count % 2 == 1, (b[0] >= 0) != (b[3] >= 0)) << "trial " << trial;
    for (int i = 0; i < found.count; ++i) {
      const double t = found.at[static_cast<std::size_t>(i)];
      ASSERT_TRUE(t >= 0 && t <= 1) << "trial " << trial;
      if (i > 0) {
        ASSERT_LE(found.at[static_cast<std::size_t>(i - 1)], t) << "trial " << trial;
      }
    }
  }
}

TEST_P(BothSolvers, SolveCubicsOfLowerDegree) {
  // Bernstein forms of a line, of a parabola with two roots, and of a constant.
  const SignChanges line = GetParam()({-1, 0, 1, 2});  // -1 + 3 t
  ASSERT_EQ(line.count, 1);
  EXPECT_NEAR(line.at[0], 1.0 / 3, 1e-14);
  const SignChanges parabola = GetParam()({2, -1, -1, 2});  // 2 - 9 t + 9 t^2
  ASSERT_EQ(parabola.count, 2);
  EXPECT_NEAR(parabola.at[0], 1.0 / 3, 1e-14);
  EXPECT_NEAR(parabola.at[1], 2.0 / 3, 1e-14);
  EXPECT_EQ(GetParam()({1, 1, 1, 1}).count, 0);
  EXPECT_EQ(GetParam()({0, 0, 0, 0}).count, 0);
  EXPECT_EQ(GetParam()({-1, -1, -1, -1}).count, 0);
}

TEST_P(BothSolvers, LeaveOutATouch) {
  EXPECT_EQ(GetParam()({1, -1.0 / 3, -1.0 / 3, 1}).count % 2, 0);  // (1 - 2t)^2
  EXPECT_EQ(GetParam()({1, 0, 0, 1}).count, 0);
}

TEST(BracketedSolver, ResidualIsRounding) {
  Rng rng(3);
  for (int trial = 0; trial < 100000; ++trial) {
    BernsteinCubic b;
    double largest = 0;
    for (double& value : b) {
      value = rng.uniform(-255, 255);
      if (rng.below(4) == 0) value *= 1e-6;
      largest = std::max(largest, std::abs(value));
    }
    const SignChanges found = bracketed_sign_changes(b);
    for (int i = 0; i < found.count; ++i)
      ASSERT_LT(std::abs(static_cast<double>(value_at(b, found.at[static_cast<std::size_t>(i)]))), 1e-14 * largest)
          << "trial " << trial;
  }
}

TEST(BracketedSolver, FindsPairsOfRootsThatAreCloseTogether) {
  Rng rng(4);
  for (int trial = 0; trial < 20000; ++trial) {
    const double r = rng.uniform(0.05, 0.95);
    const double gap = std::pow(10, rng.uniform(-5, -2));
    const SignChanges found = bracketed_sign_changes(cubic_with_roots(r, r + gap, rng.uniform(1.1, 5), 1));
    ASSERT_EQ(found.count, 2) << "trial " << trial;
    ASSERT_NEAR(found.at[0], r, 1e-9) << "trial " << trial;
    ASSERT_NEAR(found.at[1], r + gap, 1e-9) << "trial " << trial;
  }
}

// The leading term counts as zero, and the parabola without it stays above zero: the only root is lost.
TEST(SchwarzeSignChanges, FindsARootThatTheClosedFormLoses) {
  const double c0 = 1 + 5e-6, c1 = -2, c2 = 1, c3 = -1e-5;  // (1 - t)^2 + 5e-6 - 1e-5 t^3
  ASSERT_EQ(schwarze_roots({c0, c1, c2, c3}).count, 0);
  const BernsteinCubic b = {c0, c0 + c1 / 3, c0 + 2 * c1 / 3 + c2 / 3, c0 + c1 + c2 + c3};
  const SignChanges found = schwarze_sign_changes(b);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(static_cast<double>(value_at(b, found.at[0])), 0, 1e-14);
  EXPECT_NEAR(found.at[0], bracketed_sign_changes(b).at[0], 1e-12);
}

TEST(SchwarzeRoots, GivesAllRealRootsOfOddMultiplicity) {
  const SignChanges three = schwarze_roots({-6, 11, -6, 1});  // 1, 2, 3
  ASSERT_EQ(three.count, 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(three.at[static_cast<std::size_t>(i)], i + 1, 1e-12);
  const SignChanges triple = schwarze_roots({-8, 12, -6, 1});  // 2 three times
  ASSERT_EQ(triple.count, 1);
  EXPECT_NEAR(triple.at[0], 2, 1e-4);
  const SignChanges with_double = schwarze_roots({-2, 5, -4, 1});  // 1 twice, 2
  ASSERT_EQ(with_double.count, 1);
  EXPECT_NEAR(with_double.at[0], 2, 1e-7);
  EXPECT_EQ(schwarze_roots({1, 0, 1, 0}).count, 0);
  EXPECT_EQ(schwarze_roots({5, 0, 0, 0}).count, 0);
}

}  // namespace
}  // namespace deliso
