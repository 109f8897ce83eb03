// Boxes of sample layers in a volume, near which repair looks for defects.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/topology/crossing_index.h"

namespace deliso {

// Sample layers from `first` to `last`, inclusive.
struct LayerRange {
  std::int32_t first = 0;
  std::int32_t last = 0;

  friend bool operator==(const LayerRange&, const LayerRange&) = default;
};

// A range along each axis.
using IndexBox = std::array<LayerRange, 3>;

// Where a component differs from its main piece.
struct IndexRanges {
  std::vector<IndexBox> all;     // empty if it is not known
  std::vector<IndexBox> likely;  // the more likely ones, or all

  friend bool operator==(const IndexRanges&, const IndexRanges&) = default;
};

// The distance of a cell from the nearest of some boxes, in layers along the axis along which it is largest. For
// queries of many cells of a volume with so many samples.
class DistanceFromRanges {
 public:
  DistanceFromRanges(std::vector<IndexBox> boxes, const std::array<std::int32_t, 3>& dims, std::int32_t reach);
  // Exact up to `reach`; a larger result only says that the distance is above `reach`.
  [[nodiscard]] std::int32_t operator()(const CellIndex& cell) const;

 private:
  std::vector<IndexBox> boxes_;
  std::int32_t reach_;
  // Along each axis, of each layer: the distance along this axis alone.
  std::array<std::vector<std::int32_t>, 3> at_least_;
};

}  // namespace deliso
