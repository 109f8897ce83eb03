#include "experiments/commands/sample_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "volume/filters/isovalue_choice.h"
#include "volume/not_finite.h"

namespace deliso {
namespace {

// Number and sum of the samples in the bins before each bin edge.
struct CumulativeSums {
  std::vector<double> counts;
  std::vector<double> sums;
};

CumulativeSums cumulative_sums(const SampleHistogram& histogram) {
  CumulativeSums cumulative{{0}, {0}};
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const auto count = static_cast<double>(histogram.counts[bin]);
    cumulative.counts.push_back(cumulative.counts.back() + count);
    cumulative.sums.push_back(cumulative.sums.back() + count * static_cast<double>(bin));
  }
  return cumulative;
}

// A class's contribution to the variance between classes, up to a constant: (sum of its values)^2 / its size.
double class_score(const CumulativeSums& cumulative, std::size_t first, std::size_t last) {
  const double count = cumulative.counts[last] - cumulative.counts[first];
  const double sum = cumulative.sums[last] - cumulative.sums[first];
  return count > 0 ? sum * sum / count : 0;
}

// The two bin edges that split the bins into three classes with the largest variance between them.
std::vector<std::size_t> best_two_edges(const SampleHistogram& histogram) {
  const CumulativeSums cumulative = cumulative_sums(histogram);
  const std::size_t bins = histogram.counts.size();
  std::vector<std::size_t> best;
  double best_score = -1;
  for (std::size_t a = 1; a < bins; ++a) {
    for (std::size_t b = a + 1; b < bins; ++b) {
      const double score =
          class_score(cumulative, 0, a) + class_score(cumulative, a, b) + class_score(cumulative, b, bins);
      if (score <= best_score) continue;
      best_score = score;
      best = {a, b};
    }
  }
  return best;
}

}  // namespace

SampleHistogram sample_histogram(const Samples& samples, std::int32_t bins) {
  SampleHistogram histogram;
  std::tie(histogram.low, histogram.high) = finite_range(samples);
  const bool integers = visit_samples(
      samples, [](const auto& all) { return std::is_integral_v<typename std::decay_t<decltype(all)>::value_type>; });
  if (integers) {
    // As few bins as possible, each with a whole number of integers.
    const double values = histogram.high - histogram.low + 1;
    const double width = std::ceil(values / bins);
    histogram.counts.resize(static_cast<std::size_t>(std::ceil(values / width)));
    histogram.low -= 0.5;
    histogram.high = histogram.low + width * static_cast<double>(histogram.counts.size());
  } else {
    histogram.counts.resize(histogram.low < histogram.high ? static_cast<std::size_t>(bins) : 1);
  }
  // Halves, because the difference of two doubles may overflow.
  const double half_range = histogram.high / 2 - histogram.low / 2;
  visit_samples(samples, [&](const auto& all) {
    for (const auto sample : all) {
      const double share = half_range > 0 ? (static_cast<double>(sample) / 2 - histogram.low / 2) / half_range : 0;
      const auto bin = static_cast<std::size_t>(share * static_cast<double>(histogram.counts.size()));
      ++histogram.counts[std::min(bin, histogram.counts.size() - 1)];
    }
  });
  return histogram;
}

std::vector<IsovalueSuggestion> suggested_isovalues(const Samples& samples, const SampleHistogram& histogram) {
  const auto filled = std::count_if(histogram.counts.begin(), histogram.counts.end(), [](auto n) { return n > 0; });
  if (filled < 2) return {};
  std::vector<IsovalueSuggestion> suggestions = {{otsu_isovalue(samples), "separates two classes (Otsu)", "otsu"}};
  if (filled == 2) return suggestions;
  for (const std::size_t edge : best_two_edges(histogram)) {
    const double isovalue = middle_of_gap(samples, histogram.low + static_cast<double>(edge) * histogram.bin_width());
    // Where one value has most of the samples, several edges may have the same gap.
    const auto is_same = [isovalue](const IsovalueSuggestion& known) { return known.isovalue == isovalue; };
    if (std::any_of(suggestions.begin(), suggestions.end(), is_same)) continue;
    suggestions.push_back({isovalue, "separates three classes (Otsu)", ""});
  }
  return suggestions;
}

}  // namespace deliso
