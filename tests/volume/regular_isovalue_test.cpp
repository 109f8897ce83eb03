// Isovalues that equal no sample.
#include "volume/regular_isovalue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "volume/filters/closing.h"

namespace deliso {
namespace {

template <class Sample>
class RegularIsovalueOfType : public testing::Test {};
using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(RegularIsovalueOfType, SampleTypes);

TYPED_TEST(RegularIsovalueOfType, IsOneHundredthOfTheGapBelow) {
  const ScalarGrid grid({2, 2, 2}, std::vector<TypeParam>{10, 20, 20, 30, 100, 10, 20, 110});
  EXPECT_EQ(regular_isovalue(grid, 25), 25);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 20), 20 - 0.1);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 100), 100 - 0.7);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 10), 10 - 0.1);  // nothing below: the gap above counts
  EXPECT_EQ(regular_isovalue(grid, 5), 5);
  EXPECT_EQ(regular_isovalue(grid, 500), 500);
}

TEST(RegularIsovalue, LiesBetweenTheSampleAndTheNextLowerOneForRandomData) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    std::vector<double> samples(27);
    for (double& s : samples) s = (std::floor(rng.uniform(0, 30)) * std::pow(10.0, rng.uniform(-9, 9)));
    const ScalarGrid grid({3, 3, 3}, samples);
    const double isovalue = samples[rng.below(27)];
    const double regular = regular_isovalue(grid, isovalue);
    EXPECT_LT(regular, isovalue) << "seed " << seed;
    for (const double s : samples) EXPECT_FALSE(s >= regular && s < isovalue) << "seed " << seed;
  }
}

// A sample that equals the isovalue and has lower ones on both sides along an axis would be left as a grain, a wire or
// a wall as thin as the isovalue is lowered.
TYPED_TEST(RegularIsovalueOfType, IsLowerWhereTheSurfaceWouldBeThin) {
  const Dims dims{3, 4, 3};
  int thin = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    std::vector<TypeParam> samples(36, TypeParam{20});
    for (int i = 0; i < 6; ++i) samples[rng.below(36)] = static_cast<TypeParam>(10 * rng.below(2));
    const ScalarGrid grid(dims, samples);
    bool is_thin = false, has_equal = false;
    for (std::int32_t k = 0; k < 3; ++k)
      for (std::int32_t j = 0; j < 4; ++j)
        for (std::int32_t i = 0; i < 3; ++i) {
          if (grid.at(i, j, k) != 20) continue;
          has_equal = true;
          const auto lower = [&](std::int32_t x, std::int32_t y, std::int32_t z) { return grid.at(x, y, z) < 20; };
          is_thin = is_thin || (i == 1 && lower(0, j, k) && lower(2, j, k)) ||
                    (j > 0 && j < 3 && lower(i, j - 1, k) && lower(i, j + 1, k)) ||
                    (k == 1 && lower(i, j, 0) && lower(i, j, 2));
        }
    ASSERT_TRUE(has_equal);
    (is_thin ? thin : others) += 1;
    const double gap = std::count(samples.begin(), samples.end(), TypeParam{10}) > 0 ? 10 : 20;
    EXPECT_DOUBLE_EQ(regular_isovalue(grid, 20), 20 - (is_thin ? 0.382 : 0.01) * gap) << "seed " << seed;
  }
  EXPECT_GT(thin, 20);
  EXPECT_GT(others, 20);
}

// Steps of a tenth: no float is 0.6, and 3 * 0.1 is a unit in the last place above 0.3. Samples that an isovalue means
// are inside, wherever rounding puts them, and not a hair away.
template <class Sample>
void expect_decimal_steps_to_be_met(double step) {
  for (int wanted = 1; wanted < 20; ++wanted) {
    std::vector<Sample> samples;
    for (int i = 0; i < 64; ++i) samples.push_back(static_cast<Sample>(step * (i % 20)));
    samples[21] = static_cast<Sample>(step * wanted);  // not on the box
    const double isovalue = std::stod(std::to_string(step * wanted));
    const double regular = regular_isovalue(ScalarGrid({4, 4, 4}, samples), isovalue);
    EXPECT_LE(regular, (wanted - 0.0099) * step) << isovalue;
    EXPECT_GE(regular, (wanted - 0.39) * step) << isovalue;
  }
}

TEST(RegularIsovalue, MeetsDecimalSteps) {
  for (const double step : {0.1, 0.01, 0.7, 12.3}) {
    expect_decimal_steps_to_be_met<float>(step);
    expect_decimal_steps_to_be_met<double>(step);
  }
}

TEST(RegularIsovalue, IsTheIsovalueItselfWhereSamplesAreDense) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng(seed);
    std::vector<double> samples(1000);
    for (double& s : samples) s = 1 + 1e-5 * rng.uniform();
    samples[0] = -1e6;
    samples[1] = 1e9;
    const double isovalue = rng.uniform(1, 1 + 1e-5);
    EXPECT_EQ(regular_isovalue(ScalarGrid({10, 10, 10}, samples), isovalue), isovalue);
  }
}

// Pressures beside a fill value of 0: all within a millionth of each other, and every digit counts.
TEST(RegularIsovalue, IsTheIsovalueItselfAmongSamplesThatHardlyDiffer) {
  for (const double step : {1e-7, 1e-4, 0.01, 0.02, 0.03, 0.5}) {
    std::vector<double> samples(27, 0.0);
    for (std::size_t i = 0; i < 9; ++i) samples[3 * i] = 101325 + step * static_cast<double>(i % 3);
    for (const double between : {0.1, 0.3, 0.5, 0.9, 1.5}) {
      const double isovalue = 101325 + between * step;
      EXPECT_EQ(regular_isovalue(ScalarGrid({3, 3, 3}, samples), isovalue), isovalue) << step;
    }
  }
  const ScalarGrid large({2, 2, 2}, std::vector<std::int32_t>{0, 0, 0, 0, 99'999'990, 99'999'999, 100'000'000, 0});
  EXPECT_DOUBLE_EQ(regular_isovalue(large, 100'000'000), 100'000'000 - 0.01);
}

// The same samples are above and below it, but the surface no longer pinches at those next to it.
TEST(RegularIsovalue, IsMovedAwayFromIntegersOnTheirSide) {
  for (const double hair : {1e-12, 1e-9, 4e-8}) {
    const std::vector<std::int16_t> wide = {10, 20, 20, 30, 10, 20, 40, 40};
    const ScalarGrid grid({2, 2, 2}, wide);
    EXPECT_DOUBLE_EQ(regular_isovalue(grid, 20 * (1 - hair)), 19.9);
    EXPECT_DOUBLE_EQ(regular_isovalue(grid, 20 * (1 + hair)), 20.1);
    const ScalarGrid thin({3, 2, 2}, std::vector<std::int16_t>{10, 20, 10, 10, 10, 10, 30, 20, 30, 30, 30, 30});
    EXPECT_DOUBLE_EQ(regular_isovalue(thin, 20 * (1 - hair)), 20 - 3.82);
    EXPECT_DOUBLE_EQ(regular_isovalue(thin, 20 * (1 + hair)), 20 + 3.82);
    // Nothing lies beyond the lowest and the highest sample, and samples that are no integers differ by less.
    EXPECT_EQ(regular_isovalue(grid, 10 * (1 - hair)), 10 * (1 - hair));
    EXPECT_EQ(regular_isovalue(grid, 40 * (1 + hair)), 40 * (1 + hair));
  }
  const ScalarGrid near({2, 2, 2}, std::vector<std::int16_t>{0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_EQ(regular_isovalue(near, 1e-5), 1e-5);
  EXPECT_DOUBLE_EQ(regular_isovalue(near, 1e-9), 0.01);
  const ScalarGrid floats({2, 2, 2}, std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_EQ(regular_isovalue(floats, 1e-9), 1e-9);
}

TEST(RegularIsovalue, TellsTheSamplesAroundAValue) {
  const ScalarGrid grid({2, 2, 2}, std::vector<float>{1, 3, 3, 1, 7, 7, 1, 1});
  EXPECT_EQ(samples_around(grid, 3.5), std::pair(3.0, 7.0));
  EXPECT_EQ(samples_around(grid, 3), std::pair(1.0, 7.0));
  EXPECT_EQ(samples_around(grid, 1).first, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(samples_around(grid, 8).second, std::numeric_limits<double>::infinity());
}

TEST(RegularIsovalue, WorksInGapsOfOneDoubleAndInConstantVolumes) {
  const double a = 1.0;
  const double b = std::nextafter(a, 2.0);
  const double c = std::nextafter(b, 2.0);
  // No double lies between c, b and a, so the value falls below a; with only a and c it is b.
  const ScalarGrid dense({2, 2, 2}, std::vector<double>{a, b, c, 0.5, a, b, c, 0.5});
  EXPECT_DOUBLE_EQ(regular_isovalue(dense, c), 1 - 0.005);
  const ScalarGrid loose({2, 2, 2}, std::vector<double>{a, c, a, c, a, c, a, c});
  EXPECT_EQ(regular_isovalue(loose, c), b);
  const ScalarGrid constant({2, 2, 2}, std::vector<double>(8, 4.0));
  EXPECT_DOUBLE_EQ(regular_isovalue(constant, 4), 3.96);
  // A layer that closes a solid is below it by about as much: between doubles next to each other nothing can be.
  EXPECT_DOUBLE_EQ(regular_isovalue(ScalarGrid({2, 2, 2}, std::vector<double>(8, 0.0)), 0), -0.01);
  const ScalarGrid full({2, 2, 2}, std::vector<double>{a, b, c, a, b, c, a, b});
  EXPECT_THROW((void)regular_isovalue(full, c), InputError);
}

// What lies a few units in the last place off the isovalue is what is left of terms that cancel; crossings at it would
// be one point.
TEST(RegularIsovalue, TakesRemaindersForTheIsovalue) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const double scale = std::pow(10.0, rng.uniform(-20, 20));
    std::vector<double> samples(125);
    for (double& s : samples) {
      const double kind = rng.uniform(0, 3);
      const double far = rng.uniform(1, 2);
      const double remainder = rng.uniform(-1e-15, 1e-15) * (rng.uniform() < 0.5 ? 1 : 1e-16);
      s = scale * (kind < 1 ? remainder : kind < 2 ? far : -far);
    }
    const double regular = regular_isovalue(ScalarGrid({5, 5, 5}, samples), 0);
    EXPECT_LT(regular, -0.009 * scale) << "seed " << seed;
    EXPECT_GT(regular, -0.9 * scale) << "seed " << seed;
  }
}

TEST(RegularIsovalue, IsWellOffOneSampleValueHoweverNear) {
  for (const double off : {1e-300, 1e-100, 1e-20, 1e-15}) {
    const std::vector<double> three{0, 0, -1, 0, 1, 0, -1, 1};
    for (const double isovalue : {off, -off}) {
      EXPECT_DOUBLE_EQ(regular_isovalue(ScalarGrid({2, 2, 2}, three), isovalue), -0.01) << isovalue;
    }
    // The lowest sample stays below.
    const std::vector<double> two{0, 0, 1, 0, 1, 0, 1, 1};
    EXPECT_DOUBLE_EQ(regular_isovalue(ScalarGrid({2, 2, 2}, two), off), 0.01);
    EXPECT_DOUBLE_EQ(regular_isovalue(ScalarGrid({2, 2, 2}, std::vector<std::uint8_t>(two.begin(), two.end())), off),
                     0.01);
    EXPECT_EQ(regular_isovalue(ScalarGrid({2, 2, 2}, two), -off), -off);
  }
}

// Samples that count, between fill values of both signs or beside one: far smaller than these, but no remainders.
TEST(RegularIsovalue, IsTheIsovalueItselfBetweenFillValues) {
  for (const double fill : {1e20, 1e30, 3.4e38, 1e300}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      Rng rng(seed);
      std::vector<double> samples(125);
      for (double& s : samples) s = rng.uniform(-3, 3);
      samples[rng.below(62)] = fill;
      if (seed % 2 == 0) samples[62 + rng.below(62)] = -fill;
      EXPECT_EQ(regular_isovalue(ScalarGrid({5, 5, 5}, samples), 0.1), 0.1) << fill << " seed " << seed;
    }
  }
}

// The layer that closes a solid lies far below: no isovalue may be lowered towards it.
TEST(RegularIsovalue, DoesNotCountALayerAroundTheWalls) {
  const std::vector<double> ball = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 1,
                                    -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
  const ScalarGrid grid({3, 3, 3}, ball);
  for (const double isovalue : {-0.999999999, -0.9999999, -0.5, 0.0, 0.9999999999}) {
    for (const Inside inside : {Inside::kAbove, Inside::kBelow}) {
      const ClosedGrid closed = closed_grid(grid, isovalue, inside);
      EXPECT_EQ(regular_isovalue(closed.grid, closed.isovalue), closed.isovalue) << isovalue;
      EXPECT_GE(lowered_isovalue(closed.grid, closed.isovalue), -1.02) << isovalue;
      EXPECT_GT(closed.isovalue, -1) << isovalue;
    }
  }
}

}  // namespace
}  // namespace deliso
