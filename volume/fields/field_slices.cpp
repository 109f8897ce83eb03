#include "volume/fields/field_slices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

// Integer types take the nearest value, clamped to the type.
template <class Sample>
Sample converted(double value) {
  if constexpr (std::is_integral_v<Sample>) {
    constexpr double kLow = std::numeric_limits<Sample>::min();
    constexpr double kHigh = std::numeric_limits<Sample>::max();
    return static_cast<Sample>(std::lround(std::clamp(value, kLow, kHigh)));
  } else {
    return static_cast<Sample>(value);
  }
}

}  // namespace

FieldSlices::FieldSlices(const AnalyticField& field, std::int32_t size, std::uint64_t seed)
    : size_(size), type_(kept_as(parse_stored_type(field.type_name).value()).value()) {
  if (size < 2 || size > kLargestFieldSize)
    throw InputError("the size of a built-in field is " + std::to_string(size) + ", expected 2 to " +
                     std::to_string(kLargestFieldSize));
  values_ = field.values(size, seed);
}

template <class Sample>
void FieldSlices::append_next(std::vector<Sample>& samples) {
  const auto at = [this](std::int32_t n) {
    return (2.0 * n - (size_ - 1)) / (size_ - 1);
  };  // symmetric to the last bit
  for (std::int32_t j = 0; j < size_; ++j)
    for (std::int32_t i = 0; i < size_; ++i) samples.push_back(converted<Sample>(values_({at(i), at(j), at(next_)})));
  ++next_;
}

Samples FieldSlices::next(std::int32_t slices) {
  const auto per_slice = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  return visit_samples(empty_samples(type_), [&]<class Sample>(const SampleArray<Sample>& /*empty*/) -> Samples {
    std::vector<Sample> samples;
    samples.reserve(per_slice * static_cast<std::size_t>(slices));
    for (std::int32_t n = 0; n < slices; ++n) append_next(samples);
    return samples;
  });
}

ScalarGrid generate_field(std::string_view name, std::int32_t size, std::uint64_t seed) {
  FieldSlices slices(find_analytic_field(name), size, seed);
  return {{size, size, size}, slices.next(size)};
}

}  // namespace deliso
