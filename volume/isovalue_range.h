// Which isovalues have an isosurface.
#pragma once

#include <string>

#include "delaunay/base/shortest_text.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A sample that equals the isovalue counts as above it, so the surface has a point where low < isovalue <= high.
inline bool has_isosurface(const ScalarGrid& grid, double isovalue) {
  const auto [low, high] = grid.range();
  return low < isovalue && isovalue <= high;
}

// For a message: the data's range, and that its lowest value is no isovalue when that is what was overlooked.
inline std::string isovalue_range_text(const ScalarGrid& grid, double isovalue) {
  const auto [low, high] = grid.range();
  const std::string range = "the data's range is " + shortest_text(low) + " to " + shortest_text(high);
  return isovalue <= low ? range + ", and an isovalue must lie above the minimum" : range;
}

}  // namespace deliso
