// NaN and infinities among samples, which no grid holds: counted, named, replaced.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "volume/scalar_grid.h"

namespace deliso {

struct NotFiniteCounts {
  std::uint64_t nan = 0, plus_infinite = 0, minus_infinite = 0;

  [[nodiscard]] std::uint64_t count() const { return nan + plus_infinite + minus_infinite; }
};
NotFiniteCounts count_not_finite(const Samples& samples);

// "sample (3, 0, 1) is NaN" of the first that is not finite. Precondition: there is one.
std::string first_not_finite_text(const Samples& samples, const Dims& dims);
// The same of samples at the grid's places, as their file counts them: `first` is its number of the first of them.
std::string first_not_finite_text(const Samples& samples, const ScalarGrid& grid,
                                  const std::array<std::int32_t, 3>& first);

// The finite samples alone, in their order.
Samples finite_samples(const Samples& samples);

// Smallest and largest finite sample. Throws InputError when no sample is finite.
std::pair<double, double> finite_range(const Samples& samples);

// The samples with other values for NaN, -infinity and +infinity.
Samples with_finite_samples(const Samples& samples, double nan, double low, double high);

}  // namespace deliso
