#include "volume/filters/labels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

namespace {

constexpr std::size_t kMostLabels = 64;

// Neighbours along x.
struct Neighbours {
  std::size_t pairs = 0;
  std::size_t equal = 0;
  std::size_t single = 0;   // samples that differ from the one before and the one after
  std::size_t between = 0;  // of these, those that lie between the two

  // Most samples equal the next one.
  [[nodiscard]] bool are_patches() const {
    constexpr double kMostlyEqual = 0.8;
    return static_cast<double>(equal) >= kMostlyEqual * static_cast<double>(pairs);
  }
  // From one patch to the next the samples go up or down by steps, as at the edges of a smoothed mask. Labels are
  // names: what lies between two patches is seldom between their numbers.
  [[nodiscard]] bool have_ramps() const {
    constexpr double kOften = 0.1, kMostly = 0.9;
    return static_cast<double>(single) > kOften * static_cast<double>(pairs - equal) &&
           static_cast<double>(between) > kMostly * static_cast<double>(single);
  }
};

Neighbours neighbours_of(const ScalarGrid& grid) {
  return visit_samples(grid.samples(), [&](const auto& samples) {
    const auto row = static_cast<std::size_t>(grid.dims()[0]);
    Neighbours found;
    for (std::size_t first = 0; first < samples.size(); first += row) {
      for (std::size_t i = first + 1; i < first + row; ++i) {
        ++found.pairs;
        found.equal += samples[i] == samples[i - 1] ? 1 : 0;
        if (i + 1 == first + row || samples[i] == samples[i - 1] || samples[i] == samples[i + 1]) continue;
        ++found.single;
        found.between += (samples[i - 1] < samples[i]) == (samples[i] < samples[i + 1]) ? 1 : 0;
      }
    }
    return found;
  });
}

bool are_whole(const ScalarGrid& grid) {
  return visit_samples(grid.samples(), [](const auto& samples) {
    return std::all_of(samples.begin(), samples.end(), [](auto sample) {
      const auto value = static_cast<double>(sample);
      return value == std::floor(value);
    });
  });
}

std::string labels_text(const ScalarGrid& grid) {
  const std::optional<std::vector<double>> values = distinct_values(grid, kMostLabels);
  if (!values) {
    const auto [low, high] = grid.range();
    const std::string range = " from " + shortest_text(low) + " to " + shortest_text(high);
    return are_whole(grid) ? "whole numbers" + range
                           : "numbers" + range + " that are not all whole, so they are no labels";
  }
  std::string text = values->size() == 1 ? "all " : "the values ";
  for (std::size_t i = 0; i < values->size(); ++i) text += (i > 0 ? ", " : "") + shortest_text((*values)[i]);
  return text;
}

[[noreturn]] void fail_without_label(const ScalarGrid& grid, std::int32_t label) {
  throw InputError("no sample has the label " + std::to_string(label) + ": the samples are " + labels_text(grid));
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
  constexpr std::size_t kFew = 5;  // nested labels of so few numbers may lie in layers of one sample
  const std::optional<std::vector<double>> values = distinct_values(grid, kMostLabels);
  if (!values || values->size() < 2) return {};
  const auto is_whole = [](double value) { return value == std::floor(value); };
  if (!std::all_of(values->begin(), values->end(), is_whole)) return {};
  if (values->size() == 2) return {SampleKind::kMask, *values};
  const Neighbours neighbours = neighbours_of(grid);
  if (!neighbours.are_patches() || (values->size() > kFew && neighbours.have_ramps())) return {};
  return {SampleKind::kLabels, *values};
}

void check_labels(const ScalarGrid& grid, const std::vector<std::int32_t>& labels) {
  for (const std::int32_t label : labels) {
    const bool is_found = visit_samples(grid.samples(), [label](const auto& samples) {
      return std::any_of(samples.begin(), samples.end(),
                         [label](auto sample) { return static_cast<double>(sample) == label; });
    });
    if (!is_found) fail_without_label(grid, label);
  }
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
  if (!is_found) fail_without_label(grid, label);
  return {grid.dims(), std::move(mask), grid.spacing(), grid.origin()};
}

}  // namespace deliso
