// Isovalues by name against their definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "volume/filters/isovalue_choice.h"

namespace deliso {
namespace {

// n m (difference of the means)^2 of the samples below and not below a threshold.
double variance_between(const std::vector<double>& samples, double threshold) {
  double count[2] = {0, 0}, sum[2] = {0, 0};
  for (const double sample : samples) {
    count[sample < threshold ? 0 : 1] += 1;
    sum[sample < threshold ? 0 : 1] += sample;
  }
  if (count[0] == 0 || count[1] == 0) return 0;
  const double difference = sum[0] / count[0] - sum[1] / count[1];
  return count[0] * count[1] * difference * difference;
}

// Of every threshold that there is.
double best_variance(const std::vector<double>& samples) {
  double best = 0;
  for (const double threshold : samples) best = std::max(best, variance_between(samples, threshold));
  return best;
}

void expect_middle_of_a_gap(const std::vector<double>& samples, double isovalue) {
  double below = -std::numeric_limits<double>::infinity(), above = std::numeric_limits<double>::infinity();
  for (const double sample : samples) {
    if (sample < isovalue) below = std::max(below, sample);
    if (sample >= isovalue) above = std::min(above, sample);
  }
  EXPECT_EQ(isovalue, below / 2 + above / 2);
}

template <class Sample>
void expect_otsu(const std::vector<Sample>& samples, double tolerance) {
  const double isovalue = otsu_isovalue(Samples(SampleArray<Sample>(samples)));
  const std::vector<double> values(samples.begin(), samples.end());
  EXPECT_NEAR(variance_between(values, isovalue) / best_variance(values), 1, tolerance);
  expect_middle_of_a_gap(values, isovalue);
}

TEST(IsovalueChoice, OtsuHasTheLargestVarianceOfAllThresholds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    std::vector<std::uint8_t> bytes;
    std::vector<std::int16_t> shorts;
    std::vector<float> floats;
    for (int i = 0; i < 300; ++i) {
      const auto skewed = static_cast<double>(rng.below(100) * rng.below(100)) / 9801;
      bytes.push_back(static_cast<std::uint8_t>(250 * skewed));
      shorts.push_back(static_cast<std::int16_t>(-30000 + 60000 * skewed));
      floats.push_back(static_cast<float>(std::exp(5 * skewed)));
    }
    expect_otsu(bytes, 1e-12);
    expect_otsu(shorts, 1e-12);
    expect_otsu(floats, 1e-6);  // by bins
  }
  expect_otsu(std::vector<std::int32_t>{-2000000000, -1999999999, 5, 2000000000}, 1e-6);
}

TEST(IsovalueChoice, OfAMaskEveryNameIsHalfWay) {
  for (const double high : {1.0, 255.0}) {
    std::vector<std::uint8_t> samples(1000, 0);
    for (int i = 0; i < 30; ++i) samples[static_cast<std::size_t>(7 * i)] = static_cast<std::uint8_t>(high);
    const Samples mask{SampleArray<std::uint8_t>(samples)};
    for (const char* name : {"otsu", "mean", "median", "50%"}) {
      EXPECT_EQ(isovalue_of(mask, *parse_isovalue_name(name)), high / 2) << name;
    }
  }
}

TEST(IsovalueChoice, TheMiddleLeavesTheSameSamplesAbove) {
  const Samples samples{SampleArray<float>(std::vector<float>{1, 2, 4, 8, 16})};
  EXPECT_EQ(middle_of_gap(samples, 3.9), 3);
  EXPECT_EQ(middle_of_gap(samples, 4), 3);
  EXPECT_EQ(middle_of_gap(samples, 4.1), 6);
  EXPECT_EQ(middle_of_gap(samples, 1), 1.5);  // all would lie above it
  EXPECT_EQ(middle_of_gap(samples, -5), 1.5);
  EXPECT_EQ(middle_of_gap(samples, 16.5), 12);  // none would
  EXPECT_EQ(mean_isovalue(samples), 6);         // the mean is 6.2
  EXPECT_EQ(median_isovalue(samples), 3);
  EXPECT_EQ(isovalue_of(samples, *parse_isovalue_name("20%")), 4);  // a share of the range is taken as it is
  EXPECT_EQ(otsu_isovalue(Samples(SampleArray<float>(std::vector<float>(8, 3)))), 3);
}

// The middle between the two samples in the middle, or where they are one value, of a gap beside it: the lower one but
// for the lowest value.
TEST(IsovalueChoice, TheMedianHasHalfOfTheSamplesAboveIt) {
  const auto median = [](const auto& values) {
    using Sample = typename std::decay_t<decltype(values)>::value_type;
    return median_isovalue(Samples(SampleArray<Sample>(values)));
  };
  EXPECT_EQ(median(std::vector<std::uint8_t>{7, 6, 5, 4, 3, 2, 1, 0}), 3.5);
  EXPECT_EQ(median(std::vector<std::uint8_t>{0, 1, 1, 10, 100, 200, 200, 200}), 55);
  EXPECT_EQ(median(std::vector<std::int32_t>{-4, 9}), 2.5);
  Rng rng(11);
  for (int round = 0; round < 400; ++round) {
    std::vector<double> values;
    const std::uint64_t range = 2 + rng.below(30);
    for (std::uint64_t n = 1 + rng.below(40); n > 0; --n) values.push_back(static_cast<double>(rng.below(range)) - 7);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double low = sorted[(sorted.size() - 1) / 2], high = sorted[sorted.size() / 2];
    double expected = (low + high) / 2;
    if (low == high) {
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), low);
      if (first != sorted.begin()) {
        expected = (low + *std::prev(first)) / 2;
      } else if (last != sorted.end()) {
        expected = (low + *last) / 2;
      }
    }
    EXPECT_EQ(median(values), expected) << round;
  }
}

TEST(IsovalueChoice, HoldsAtTheEndsOfTheDoubles) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(otsu_isovalue(Samples(SampleArray<double>(std::vector<double>{-huge, -huge, huge}))), 0);
  EXPECT_EQ(otsu_isovalue(Samples(SampleArray<double>(std::vector<double>{0, 0, tiny}))), tiny);
  EXPECT_EQ(mean_isovalue(Samples(SampleArray<double>(std::vector<double>{-huge, huge}))), 0);
}

TEST(IsovalueChoice, KnowsItsNames) {
  EXPECT_FALSE(parse_isovalue_name("12"));
  EXPECT_FALSE(parse_isovalue_name("Otsu"));
  EXPECT_EQ(parse_isovalue_name("12.5%")->percent, 12.5);
  for (const char* text : {"%", "0%", "100%", "-1%", "x%", "nan%"}) {
    EXPECT_THROW(parse_isovalue_name(text), InputError) << text;
  }
}

}  // namespace
}  // namespace deliso
