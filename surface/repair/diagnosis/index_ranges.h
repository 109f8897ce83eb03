// Places in a volume near which repair has something to mend.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/topology/crossing_index.h"

namespace deliso {

// Sample layers, from the first to the last.
struct LayerRange {
  std::int32_t first = 0;
  std::int32_t last = 0;

  friend bool operator==(const LayerRange&, const LayerRange&) = default;
};

// A range along each axis.
using IndexBox = std::array<LayerRange, 3>;

// Where a component and its main piece part.
struct IndexRanges {
  std::vector<IndexBox> all;     // empty when there is no telling
  std::vector<IndexBox> likely;  // some of them, or all

  friend bool operator==(const IndexRanges&, const IndexRanges&) = default;
};

// How many layers a cell is away from the nearest of some places, along the axis along which it is farthest: for many
// cells of a volume with so many samples.
class DistanceFromRanges {
 public:
  DistanceFromRanges(std::vector<IndexBox> places, const std::array<std::int32_t, 3>& dims, std::int32_t reach);
  // Exact as far as the reach, which is all that is asked of what is farther away.
  [[nodiscard]] std::int32_t operator()(const CellIndex& cell) const;

 private:
  std::vector<IndexBox> places_;
  std::int32_t reach_;
  std::array<std::vector<std::int32_t>, 3> at_least_;  // along each axis, of each layer: what that axis alone tells
};

}  // namespace deliso
