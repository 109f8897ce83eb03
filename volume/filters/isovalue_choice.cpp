#include "volume/filters/isovalue_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <system_error>
#include <type_traits>

#include "delaunay/base/check.h"
#include "volume/not_finite.h"

namespace deliso {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Without overflow.
double middle(double a, double b) { return a / 2 + b / 2; }

// Number and sum of the samples in bins of equal width. The bins of whole numbers hold one value each where the range
// allows.
struct Bins {
  double low = 0, width = 1;
  std::vector<double> counts, sums;  // sums of half of what the samples are above the lowest
};
Bins bins_of(const Samples& samples) {
  constexpr double kMost = 65536;
  const auto [low, high] = finite_range(samples);
  const bool is_whole =
      visit_samples(samples, []<class Sample>(const SampleArray<Sample>&) { return std::is_integral_v<Sample>; });
  Bins bins;
  bins.low = low;
  bins.width = is_whole ? std::ceil((high - low + 1) / kMost) : high / kMost - low / kMost;
  const double count = is_whole ? std::ceil((high - low + 1) / bins.width) : kMost;
  const double half_width = is_whole ? bins.width / 2 : (high / 2 - low / 2) / kMost;  // differences may overflow
  bins.counts.resize(static_cast<std::size_t>(count), 0);
  bins.sums.resize(bins.counts.size(), 0);
  visit_samples(samples, [&bins, half_width, lowest = low](const auto& all) {
    for (const auto sample : all) {
      const double half = static_cast<double>(sample) / 2 - lowest / 2;
      const double share = half_width > 0 ? half / half_width : 0;
      const std::size_t bin = std::min(static_cast<std::size_t>(share), bins.counts.size() - 1);
      bins.counts[bin] += 1;
      bins.sums[bin] += half;
    }
  });
  return bins;
}

// The middle between the largest of the lower class and the smallest of the upper one, where the upper class begins at
// or above `from`.
double middle_below(const Samples& samples, double from) {
  const auto [low, high] = finite_range(samples);
  double below = -kInfinity, above = kInfinity;
  visit_samples(samples, [&](const auto& all) {
    for (const auto sample : all) {
      const auto value = static_cast<double>(sample);
      if (value < from) below = std::max(below, value);
      if (value >= from) above = std::min(above, value);
    }
  });
  if (below == -kInfinity && above < high) return middle_below(samples, std::nextafter(above, kInfinity));
  if (above == kInfinity && below > low) return middle_below(samples, below);
  if (below == -kInfinity || above == kInfinity) return from;
  const double half_way = middle(below, above);
  return half_way > below ? half_way : above;
}

}  // namespace

double middle_of_gap(const Samples& samples, double isovalue) { return middle_below(samples, isovalue); }

double otsu_isovalue(const Samples& samples) {
  const auto [low, high] = finite_range(samples);
  if (!(low < high)) return low;
  const Bins bins = bins_of(samples);
  double count_in_all = 0, sum_in_all = 0;
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    count_in_all += bins.counts[i];
    sum_in_all += bins.sums[i];
  }
  double count = 0, sum = 0, best = -1;
  std::size_t first_above = 1;
  for (std::size_t i = 0; i + 1 < bins.counts.size(); ++i) {
    count += bins.counts[i];
    sum += bins.sums[i];
    const double others = count_in_all - count;
    if (bins.counts[i] == 0 || others == 0) continue;
    // The variance between two classes, up to a constant: n m (difference of their means)^2.
    const double difference = sum / count - (sum_in_all - sum) / others;
    const double variance = count * others * difference * difference;
    if (variance <= best) continue;
    best = variance;
    first_above = i + 1;
  }
  return middle_of_gap(samples, bins.low + static_cast<double>(first_above) * bins.width);
}

double mean_isovalue(const Samples& samples) {
  const double low = finite_range(samples).first;
  const double mean = visit_samples(samples, [low](const auto& all) {
    const auto count = static_cast<double>(all.size());
    double sum = 0;
    for (const auto sample : all) sum += (static_cast<double>(sample) / 2 - low / 2) / count;
    return low + 2 * sum;
  });
  return middle_of_gap(samples, mean);
}

double median_isovalue(const Samples& samples) {
  const double median = visit_samples(samples, []<class Sample>(const SampleArray<Sample>& all) {
    std::vector<Sample> copy(all.begin(), all.end());
    // Of an even number the upper one of the two in the middle: its gap is the one between them where they differ.
    const auto half = copy.begin() + static_cast<std::ptrdiff_t>(copy.size() / 2);
    std::nth_element(copy.begin(), half, copy.end());
    return static_cast<double>(*half);
  });
  return middle_of_gap(samples, median);
}

std::optional<NamedIsovalue> parse_isovalue_name(std::string_view text) {
  using Kind = NamedIsovalue::Kind;
  if (text == "otsu") return NamedIsovalue{Kind::kOtsu};
  if (text == "mean") return NamedIsovalue{Kind::kMean};
  if (text == "median") return NamedIsovalue{Kind::kMedian};
  if (!text.ends_with('%')) return std::nullopt;
  NamedIsovalue name{Kind::kPercent};
  const char* const end = text.data() + text.size() - 1;
  const auto [stop, error] = std::from_chars(text.data(), end, name.percent);
  if (error == std::errc() && stop == end && name.percent > 0 && name.percent < 100) return name;
  throw InputError("expected a share of the range above 0% and below 100%, found '" + std::string(text) + "'");
}

double isovalue_of(const Samples& samples, const NamedIsovalue& name) {
  switch (name.kind) {
    case NamedIsovalue::Kind::kOtsu:
      return otsu_isovalue(samples);
    case NamedIsovalue::Kind::kMean:
      return mean_isovalue(samples);
    case NamedIsovalue::Kind::kMedian:
      return median_isovalue(samples);
    case NamedIsovalue::Kind::kPercent:
      break;
  }
  const auto [low, high] = finite_range(samples);
  const double share = name.percent / 100;
  return (1 - share) * low + share * high;
}

}  // namespace deliso
