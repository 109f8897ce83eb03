// How the samples of a volume lie around a value.
#pragma once

#include <limits>

#include "volume/scalar_grid.h"

namespace deliso {

struct Neighbors {
  bool equal = false;                                       // some sample equals the value
  double lower = -std::numeric_limits<double>::infinity();  // the largest sample below it
  double higher = std::numeric_limits<double>::infinity();  // the smallest sample above it
};

// Without a layer around walls(), which is no part of the volume: that has the value of its first sample.
Neighbors find_neighbors(const ScalarGrid& grid, double value);

}  // namespace deliso
