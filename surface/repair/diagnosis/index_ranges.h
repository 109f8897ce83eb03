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

// Some layers of the cells of a volume along each axis, and with them the cells that lie in such layers along all axes.
class CellLayers {
 public:
  // has(axis, layer) for those of a volume with so many samples.
  template <class Has>
  CellLayers(const std::array<std::int32_t, 3>& dims, const Has& has) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      has_[axis].resize(static_cast<std::size_t>(dims[axis]) - 1);
      for (std::int32_t layer = 0; layer + 1 < dims[axis]; ++layer) {
        has_[axis][static_cast<std::size_t>(layer)] = has(axis, layer);
      }
    }
  }
  [[nodiscard]] bool has(std::size_t axis, std::int32_t layer) const {
    return has_[axis][static_cast<std::size_t>(layer)];
  }
  [[nodiscard]] bool contain(const CellIndex& cell) const {
    return has(2, cell[2]) && has(1, cell[1]) && has(0, cell[0]);
  }
  // Calls visit(cell, pattern) for the active cells in them, as CrossingIndex::for_each_active_cell does.
  template <class Visit>
  void for_each_active_cell(const CrossingIndex& index, const Visit& visit) const {
    for (std::int32_t k = 0; k < index.cell_layers(); ++k) {
      for (std::int32_t j = 0; has(2, k) && j < index.cell_rows(); ++j) {
        if (!has(1, j)) continue;
        index.for_each_active_cell_in_row(j, k, [&](const CellIndex& cell, std::uint8_t pattern) {
          if (has(0, cell[0])) visit(cell, pattern);
        });
      }
    }
  }

 private:
  std::array<std::vector<bool>, 3> has_;
};

// How many layers a cell is away from the nearest of some places, along the axis along which it is farthest: for many
// cells of a volume with so many samples.
class DistanceFromRanges {
 public:
  DistanceFromRanges(std::vector<IndexBox> places, const std::array<std::int32_t, 3>& dims, std::int32_t reach);
  // Exact as far as the reach, which is all that is asked of what is farther away.
  [[nodiscard]] std::int32_t operator()(const CellIndex& cell) const;
  [[nodiscard]] bool reaches(const CellIndex& cell) const { return (*this)(cell) <= reach_; }
  // Whether some cell in this layer along the axis may be reached.
  [[nodiscard]] bool reaches(std::size_t axis, std::int32_t layer) const {
    return at_least_[axis][static_cast<std::size_t>(layer)] <= reach_;
  }

 private:
  std::vector<IndexBox> places_;
  std::int32_t reach_;
  std::array<std::vector<std::int32_t>, 3> at_least_;  // along each axis, of each layer: what that axis alone tells
};

}  // namespace deliso
