// The grid: constructor checks, access, padding.
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
  // Distances are measured in the smallest spacing.
  expect_input_error([&] { ScalarGrid({2, 2, 2}, samples, {100, 1, 1}, {9e13, 0, 0}); }, {"origin", "smallest"});
  for (const double unit : {1e-100, 1.0, 1e97}) {
    const Vec3 origin{1e10 * unit, -1e12 * unit, 0};
    EXPECT_EQ(ScalarGrid({2, 2, 2}, samples, {unit, 100 * unit, 1.5 * unit}, origin).box().low, origin);
  }
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

}  // namespace
}  // namespace deliso
