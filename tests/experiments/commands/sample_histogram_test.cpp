// The histogram of info, and the isovalues that it suggests.
#include "experiments/commands/sample_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "volume/fields/field_slices.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {
namespace {

// Otsu's threshold by its definition: the largest variance between the classes, by trying all.
TEST(Histogram, SuggestedIsovalueHasTheLargestVarianceBetweenClasses) {
  const ScalarGrid grid = generate_field("shells", 24);
  const SampleHistogram histogram = sample_histogram(grid.samples());
  const auto variance_between = [&](double threshold) {
    double count[2] = {0, 0};
    double sum[2] = {0, 0};
    visit_samples(grid.samples(), [&](const auto& samples) {
      for (const auto sample : samples) {
        const int side = static_cast<double>(sample) < threshold ? 0 : 1;
        count[side] += 1;
        sum[side] += static_cast<double>(sample);
      }
    });
    if (count[0] == 0 || count[1] == 0) return 0.0;
    const double difference = sum[0] / count[0] - sum[1] / count[1];
    return count[0] * count[1] * difference * difference;
  };
  double best = 0;
  for (double threshold = 0.5; threshold < 255; ++threshold) best = std::max(best, variance_between(threshold));
  const auto suggestions = suggested_isovalues(grid.samples(), histogram);
  ASSERT_EQ(suggestions.size(), 3u);
  EXPECT_NEAR(variance_between(suggestions[0].isovalue) / best, 1, 1e-9);
  EXPECT_LT(suggestions[1].isovalue, suggestions[2].isovalue);
}

// One value has nearly all samples: its gap separates two classes, and the first two of three.
TEST(Histogram, SuggestsNoIsovalueTwice) {
  std::vector<std::uint8_t> samples(1000, 0);
  for (std::size_t i = 0; i < 4; ++i) samples[i] = static_cast<std::uint8_t>(250 + i);
  const ScalarGrid grid({10, 10, 10}, std::move(samples));
  std::set<double> isovalues;
  for (const IsovalueSuggestion& suggestion : suggested_isovalues(grid.samples(), sample_histogram(grid.samples()))) {
    EXPECT_TRUE(isovalues.insert(suggestion.isovalue).second) << suggestion.isovalue << " " << suggestion.reason;
  }
  EXPECT_TRUE(isovalues.contains(125));
}

TEST(Histogram, CountsEverySampleAtTheEndsOfTheDoubles) {
  const double huge = std::numeric_limits<double>::max();
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const std::vector<double>& ends : {std::vector<double>{-huge, huge}, {0.0, tiny}, {3.0, 3.0}}) {
    const ScalarGrid grid({2, 2, 2},
                          std::vector<double>{ends[0], ends[1], ends[0], ends[0], ends[1], ends[1], ends[1], ends[1]});
    std::uint64_t count = 0;
    for (const std::uint64_t bin : sample_histogram(grid.samples()).counts) count += bin;
    EXPECT_EQ(count, 8u);
  }
  const ScalarGrid wide({2, 2, 2}, std::vector<std::int32_t>{std::numeric_limits<std::int32_t>::min(), 0, 0, 0, 0, 0, 0,
                                                             std::numeric_limits<std::int32_t>::max()});
  const SampleHistogram histogram = sample_histogram(wide.samples());
  EXPECT_LE(histogram.counts.size(), 256u);
  EXPECT_EQ(histogram.counts.front(), 1u);
  EXPECT_EQ(histogram.counts.back(), 1u);
}

}  // namespace
}  // namespace deliso::testing
