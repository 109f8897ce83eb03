#include "volume/not_finite.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

template <class Sample>
bool all_are_finite(const SampleArray<Sample>& samples) {
  bool finite = true;  // without a branch: vectorized
  for (const Sample s : samples) finite &= std::abs(s) <= std::numeric_limits<Sample>::max();
  return finite;
}

// The nearest value of the type; what is beyond its range becomes its last.
template <class Sample>
Sample converted(double value) {
  const double most = static_cast<double>(std::numeric_limits<Sample>::max());
  return static_cast<Sample>(std::clamp(value, -most, most));
}

// The first sample in the grid's order, with the numbers that the file has for it.
std::string not_finite_text(const Samples& samples, const Dims& dims, const std::array<bool, 3>& backwards,
                            const std::array<std::int32_t, 3>& first) {
  return visit_samples(samples, [&]<class Sample>(const SampleArray<Sample>& s) {
    const auto found =
        std::find_if(s.begin(), s.end(), [](Sample v) { return !std::isfinite(static_cast<double>(v)); });
    auto n = static_cast<std::size_t>(found - s.begin());
    std::string numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto length = static_cast<std::size_t>(dims[axis]);
      const auto place = static_cast<std::int64_t>(n % length);
      n /= length;
      const std::int64_t number = first[axis] + (backwards[axis] ? dims[axis] - 1 - place : place);
      numbers += (axis > 0 ? ", " : "") + std::to_string(number);
    }
    const auto value = static_cast<double>(*found);
    return "sample (" + numbers + ") is " + (std::isnan(value) ? "NaN" : value > 0 ? "infinite" : "minus infinity");
  });
}

}  // namespace

NotFiniteCounts count_not_finite(const Samples& samples) {
  return visit_samples(samples, []<class Sample>(const SampleArray<Sample>& s) {
    NotFiniteCounts counts;
    if constexpr (std::is_floating_point_v<Sample>) {
      if (all_are_finite(s)) return counts;
      for (const Sample value : s) {
        if (std::isnan(value)) ++counts.nan;
        if (std::isinf(value)) ++(value > 0 ? counts.plus_infinite : counts.minus_infinite);
      }
    }
    return counts;
  });
}

std::string first_not_finite_text(const Samples& samples, const Dims& dims) {
  return not_finite_text(samples, dims, {}, {});
}

std::string first_not_finite_text(const Samples& samples, const ScalarGrid& grid,
                                  const std::array<std::int32_t, 3>& first) {
  return not_finite_text(samples, grid.dims(), grid.backwards(), first);
}

Samples finite_samples(const Samples& samples) {
  return visit_samples(samples, []<class Sample>(const SampleArray<Sample>& s) {
    std::vector<Sample> finite;
    std::copy_if(s.begin(), s.end(), std::back_inserter(finite),
                 [](Sample value) { return std::isfinite(static_cast<double>(value)); });
    return Samples(SampleArray<Sample>(std::move(finite)));
  });
}

std::pair<double, double> finite_range(const Samples& samples) {
  return visit_samples(samples, [](const auto& s) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::pair<double, double> range(kInfinity, -kInfinity);
    for (const auto sample : s) {
      const auto value = static_cast<double>(sample);
      if (!std::isfinite(value)) continue;
      range = {std::min(range.first, value), std::max(range.second, value)};
    }
    if (range.first <= range.second) return range;
    throw InputError("no sample is a finite number, expected some");
  });
}

Samples with_finite_samples(const Samples& samples, double nan, double low, double high) {
  return visit_samples(samples, [&]<class Sample>(const SampleArray<Sample>& s) {
    std::vector<Sample> finite(s.begin(), s.end());
    for (Sample& value : finite) {
      if (std::isfinite(static_cast<double>(value))) continue;
      value = converted<Sample>(std::isnan(static_cast<double>(value)) ? nan : value > 0 ? high : low);
    }
    return Samples(SampleArray<Sample>(std::move(finite)));
  });
}

}  // namespace deliso
