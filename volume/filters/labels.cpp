#include "volume/filters/labels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

namespace {

constexpr std::size_t kMostLabels = 64;

// The share of samples that equal the next one along x.
double share_of_equal_neighbours(const ScalarGrid& grid) {
  return visit_samples(grid.samples(), [&](const auto& samples) {
    const auto row = static_cast<std::size_t>(grid.dims()[0]);
    std::size_t equal = 0;
    for (std::size_t first = 0; first < samples.size(); first += row) {
      for (std::size_t i = first + 1; i < first + row; ++i) equal += samples[i] == samples[i - 1] ? 1 : 0;
    }
    const std::size_t pairs = samples.size() / row * (row - 1);
    return static_cast<double>(equal) / static_cast<double>(pairs);
  });
}

std::string labels_text(const ScalarGrid& grid) {
  const std::optional<std::vector<double>> values = distinct_values(grid, kMostLabels);
  if (!values) return "more than " + std::to_string(kMostLabels) + " values, so they are no labels";
  std::string text = values->size() == 1 ? "all " : "the values ";
  for (std::size_t i = 0; i < values->size(); ++i) text += (i > 0 ? ", " : "") + shortest_text((*values)[i]);
  return text;
}

}  // namespace

std::optional<std::vector<double>> distinct_values(const ScalarGrid& grid, std::size_t most) {
  return visit_samples(grid.samples(), [most](const auto& samples) -> std::optional<std::vector<double>> {
    std::vector<double> values;
    auto last = samples.front();
    values.push_back(static_cast<double>(last));
    for (const auto sample : samples) {
      if (sample == last) continue;
      last = sample;
      const auto place = std::lower_bound(values.begin(), values.end(), static_cast<double>(sample));
      if (place != values.end() && *place == static_cast<double>(sample)) continue;
      if (values.size() == most) return std::nullopt;
      values.insert(place, static_cast<double>(sample));
    }
    return values;
  });
}

SampleKinds kind_of_samples(const ScalarGrid& grid) {
  constexpr double kMostlyEqual = 0.8;
  const std::optional<std::vector<double>> values = distinct_values(grid, kMostLabels);
  if (!values || values->size() < 2) return {};
  const auto is_whole = [](double value) { return value == std::floor(value); };
  if (!std::all_of(values->begin(), values->end(), is_whole)) return {};
  if (values->size() == 2) return {SampleKind::kMask, *values};
  if (share_of_equal_neighbours(grid) < kMostlyEqual) return {};
  return {SampleKind::kLabels, *values};
}

ScalarGrid label_mask(const ScalarGrid& grid, std::int32_t label) {
  std::vector<std::uint8_t> mask(grid.sample_count());
  bool is_found = false;
  visit_samples(grid.samples(), [&](const auto& samples) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      mask[i] = static_cast<double>(samples[i]) == label ? 1 : 0;
      is_found = is_found || mask[i] != 0;
    }
  });
  if (!is_found) {
    throw InputError("no sample has the label " + std::to_string(label) + ": the samples are " + labels_text(grid));
  }
  return {grid.dims(), std::move(mask), grid.spacing(), grid.origin()};
}

}  // namespace deliso
