// Which volumes and isovalues have an isosurface that can be computed.
#pragma once

#include <string>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A sample that equals the isovalue counts as above it, so the surface has a point where low < isovalue <= high.
inline bool has_isosurface(const ScalarGrid& grid, double isovalue) {
  const auto [low, high] = grid.range();
  return low < isovalue && isovalue <= high;
}

// The range of the data, for a message; adds that the lowest value is no isovalue when that was the mistake.
inline std::string isovalue_range_text(const ScalarGrid& grid, double isovalue) {
  const auto [low, high] = grid.range();
  const std::string range = "the data's range is " + short_text(low) + " to " + short_text(high);
  return isovalue <= low ? range + ", and an isovalue must lie above the minimum" : range;
}

// Differences of samples are multiplied, and divided by each other: throws InputError when these would overflow or
// vanish.
inline void check_samples(const ScalarGrid& grid) {
  constexpr double kSmallest = 1e-300, kLargest = 1e300;
  const auto [low, high] = grid.range();
  const bool is_large = -low > kLargest || high > kLargest, is_small = low < high && high - low < kSmallest;
  if (!is_large && !is_small) return;
  throw InputError("the samples range from " + shortest_text(low) + " to " + shortest_text(high) +
                   (is_large ? ": expected samples from -1e300 to 1e300" : ": expected a range of 1e-300 or more") +
                   ", scale them");
}

}  // namespace deliso
