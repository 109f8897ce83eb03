// The grid: constructor checks, access, padding, regular isovalues.
#include "volume/scalar_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/volume_files.h"
#include "volume/isovalue_range.h"

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Sample>
class ScalarGridOfType : public testing::Test {};
using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(ScalarGridOfType, SampleTypes);

TYPED_TEST(ScalarGridOfType, AccessAgreesWithTheSamplesInFileOrder) {
  const auto samples = random_samples<TypeParam>(60, 1);
  const ScalarGrid grid({3, 4, 5}, samples);
  EXPECT_EQ(grid.sample_count(), samples.size());
  std::size_t n = 0;
  double low = kInfinity;
  double high = -kInfinity;
  for (std::int32_t k = 0; k < 5; ++k)
    for (std::int32_t j = 0; j < 4; ++j)
      for (std::int32_t i = 0; i < 3; ++i, ++n) {
        EXPECT_EQ(grid.index(i, j, k), n);
        EXPECT_EQ(grid.at(i, j, k), static_cast<double>(samples[n]));
        low = std::min(low, grid.at(i, j, k));
        high = std::max(high, grid.at(i, j, k));
      }
  EXPECT_EQ(grid.range(), (std::pair{low, high}));
}

TYPED_TEST(ScalarGridOfType, EveryCellHoldsItsEightSamples) {
  const ScalarGrid grid({3, 4, 5}, random_samples<TypeParam>(60, 2));
  for (std::int32_t k = 0; k < 4; ++k)
    for (std::int32_t j = 0; j < 3; ++j)
      for (std::int32_t i = 0; i < 2; ++i) {
        const CellCorners corners = grid.cell(i, j, k);
        for (std::int32_t n = 0; n < 8; ++n)
          EXPECT_EQ(corners[static_cast<std::size_t>(n)], grid.at(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)));
      }
}

TYPED_TEST(ScalarGridOfType, PaddingAddsOneLayerAndKeepsEverySampleInItsPlace) {
  const ScalarGrid grid({3, 4, 5}, random_samples<TypeParam>(60, 3), {0.5, 1, 2}, {10, 20, 30});
  const ScalarGrid out = padded(grid, 7);
  EXPECT_EQ(out.dims(), (Dims{5, 6, 7}));
  EXPECT_EQ(out.spacing(), grid.spacing());
  EXPECT_EQ(out.origin(), (Vec3{9.5, 19, 28}));
  EXPECT_EQ(out.type_name(), grid.type_name());
  for (std::int32_t k = 0; k < 7; ++k)
    for (std::int32_t j = 0; j < 6; ++j)
      for (std::int32_t i = 0; i < 5; ++i) {
        const bool inner = i > 0 && j > 0 && k > 0 && i < 4 && j < 5 && k < 6;
        EXPECT_EQ(out.at(i, j, k), inner ? grid.at(i - 1, j - 1, k - 1) : 7) << i << " " << j << " " << k;
      }
}

TYPED_TEST(ScalarGridOfType, PaddingIsNeverAboveTheValueUnlessTheTypeStartsAboveIt) {
  const ScalarGrid grid({2, 2, 2}, random_samples<TypeParam>(8, 4));
  for (const double value : {0.1, 10.6, -3.5, 1e-30, -1e300, 1e300, 127.0, -128.5, 65535.9, -kInfinity, kInfinity}) {
    const double layer = padded(grid, value).at(0, 0, 0);
    EXPECT_TRUE(layer <= value || layer == static_cast<double>(std::numeric_limits<TypeParam>::lowest())) << value;
  }
}

TYPED_TEST(ScalarGridOfType, RegularIsovalueIsOneHundredthOfTheGapBelow) {
  const ScalarGrid grid({2, 2, 2}, std::vector<TypeParam>{10, 20, 20, 30, 100, 10, 20, 110});
  EXPECT_EQ(regular_isovalue(grid, 25), 25);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 20), 20 - 0.1);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 100), 100 - 0.7);
  EXPECT_DOUBLE_EQ(regular_isovalue(grid, 10), 10 - 0.1);  // nothing below: the gap above counts
  EXPECT_EQ(regular_isovalue(grid, 5), 5);
  EXPECT_EQ(regular_isovalue(grid, 500), 500);
}

TEST(ScalarGrid, TypeNamesAreTheSevenOfTheInterface) {
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<std::uint8_t>(8)).type_name(), "u8");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<std::int8_t>(8)).type_name(), "i8");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<std::uint16_t>(8)).type_name(), "u16");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<std::int16_t>(8)).type_name(), "i16");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<std::int32_t>(8)).type_name(), "i32");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<float>(8)).type_name(), "f32");
  EXPECT_EQ(ScalarGrid({2, 2, 2}, std::vector<double>(8)).type_name(), "f64");
}

TEST(ScalarGrid, BoxSpansTheSamplesInTheWorld) {
  const ScalarGrid grid({3, 4, 5}, std::vector<float>(60), {0.5, 1, 2}, {-1, 0, 1});
  EXPECT_EQ(grid.box().low, (Vec3{-1, 0, 1}));
  EXPECT_EQ(grid.box().high, (Vec3{0, 3, 9}));
}

TEST(ScalarGrid, RefusesDimensionsThatMakeNoCell) {
  for (const Dims& dims : {Dims{1, 2, 2}, Dims{2, 0, 2}, Dims{2, 2, -3}, Dims{-2, -2, 2}})
    expect_input_error([&] { ScalarGrid(dims, std::vector<float>(8)); }, {"dimensions", "at least 2"});
}

TEST(ScalarGrid, RefusesSampleCountsThatDoNotFitOrOverflow) {
  expect_input_error([] { ScalarGrid({2, 2, 2}, std::vector<float>(7)); }, {"7 samples", "2 x 2 x 2", "8"});
  expect_input_error([] { ScalarGrid({2, 2, 2}, std::vector<float>(9)); }, {"9 samples"});
  expect_input_error([] { ScalarGrid({2, 2, 2}, std::vector<float>()); }, {"0 samples"});
  // 2^22 cubed is 2^66: as a 64-bit product it would be 4.
  expect_input_error([] { ScalarGrid({1 << 22, 1 << 22, 1 << 22}, std::vector<float>(4)); }, {"4194304", "address"});
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  expect_input_error([] { checked_sample_count({kMost, kMost, kMost}); }, {"address"});
  expect_input_error([] { checked_sample_count({kMost, kMost, 2}); }, {"address"});
  EXPECT_EQ(checked_sample_count({1024, 1024, 1024}), std::size_t{1} << 30);
  EXPECT_EQ(checked_sample_count({kMost, 2, 2}), std::size_t{4} * kMost);
}

TEST(ScalarGrid, RefusesGeometryThatIsNotFiniteOrNotPositive) {
  const std::vector<float> samples(8);
  for (const double bad : {0.0, -1.0, kInfinity, kNaN}) {
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {bad, 1, 1}); }, {"spacing", "must be"});
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {1, 1, bad}); }, {"spacing"});
  }
  for (const double bad : {kInfinity, -kInfinity, kNaN})
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {1, 1, 1}, {0, bad, 0}); }, {"origin"});
}

// Where coordinates or products of lengths would lose what they are to tell.
TEST(ScalarGrid, RefusesGeometryBeyondWhatDoublesCanTell) {
  const std::vector<float> samples(8);
  for (const double bad : {1e-101, 1e101, 5e-324, 1e308}) {
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {1, bad, 1}); }, {"spacing", "1e-100 to 1e100"});
  }
  for (const double bad : {2e12, -2e12, 1e308}) {
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {1, 1, 1}, {0, 0, bad}); }, {"origin", "spacing"});
    expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {1, 1, 1e-3}, {0, 0, bad / 1000}); }, {"origin"});
  }
  const ScalarGrid far({2, 2, 2}, samples, {1e-100, 1e100, 1}, {1e-90, -1e110, 1e12});
  EXPECT_EQ(far.box().low, (Vec3{1e-90, -1e110, 1e12}));
}

TEST(IsovalueRange, RefusesSamplesTooLargeOrTooCloseToComputeWith) {
  std::vector<double> samples(8, 0.0);
  for (const double bad : {1.1e300, -1.1e300, 1.7e308}) {
    samples[3] = bad;
    expect_input_error([&] { check_samples(ScalarGrid({2, 2, 2}, samples)); }, {"range", "-1e300 to 1e300", "scale"});
  }
  samples[3] = 1e-301;
  expect_input_error([&] { check_samples(ScalarGrid({2, 2, 2}, samples)); }, {"0 to 1e-301", "1e-300 or more"});
  samples[3] = 1e-300;
  check_samples(ScalarGrid({2, 2, 2}, samples));
  check_samples(ScalarGrid({2, 2, 2}, std::vector<double>(8, 5e-324)));  // all equal: no isovalue anyway
}

TEST(ScalarGrid, NamesTheFirstSampleThatIsNotFinite) {
  std::vector<float> samples(24, 1.0f);
  samples[17] = std::numeric_limits<float>::quiet_NaN();
  samples[20] = std::numeric_limits<float>::infinity();
  expect_input_error([&] { ScalarGrid({2, 3, 4}, samples); }, {"(1, 2, 2)", "NaN"});
  samples[5] = -std::numeric_limits<float>::infinity();
  expect_input_error([&] { ScalarGrid({2, 3, 4}, samples); }, {"(1, 2, 0)", "minus infinity"});
  std::vector<double> doubles(8, 1.0);
  doubles[0] = kInfinity;
  expect_input_error([&] { ScalarGrid({2, 2, 2}, doubles); }, {"(0, 0, 0)", "infinite"});
}

TEST(ScalarGrid, PaddingRefusesNaN) {
  const ScalarGrid grid({2, 2, 2}, std::vector<float>(8));
  expect_input_error([&] { padded(grid, kNaN); }, {"pad", "NaN"});
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
TYPED_TEST(ScalarGridOfType, RegularIsovalueIsLowerWhereTheSurfaceWouldBeThin) {
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

TEST(ScalarGrid, TellsTheSamplesAroundAValue) {
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

}  // namespace
}  // namespace deliso
