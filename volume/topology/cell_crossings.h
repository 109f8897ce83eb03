// The numbers of the crossings on the edges of cells, for callers that visit cells row by row.
//
// CrossingIndex::number() counts bits for every edge. This class instead numbers the crossings of a row of samples in
// one pass, each by adding 1 to the one before it. The rows of samples around a row of cells are reused for the next
// row of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/topology/crossing_index.h"

namespace deliso {

class CellCrossings {
 public:
  // Keeps a reference. Memory: 64 bytes per sample of a row.
  explicit CellCrossings(const CrossingIndex& index);
  CellCrossings(const CellCrossings&) = delete;
  CellCrossings& operator=(const CellCrossings&) = delete;

  // Moves to a cell. Fast if the cell lies in the same row along x as the last one, or in the next row along y.
  void move_to(const CellIndex& cell) {
    if (cell[1] != row_[0] || cell[2] != row_[1]) take_row(cell[1], cell[2]);
    first_ = kPerSample * static_cast<std::size_t>(cell[0]);
  }
  // The number of the crossing on an edge of the cell (cell_sweep.h), which must have one.
  [[nodiscard]] std::uint32_t number(int edge) const {
    const Place& place = places_[static_cast<std::size_t>(edge)];
    return rows_[place.row][first_ + place.offset];
  }

 private:
  // A row of samples and the numbers of the crossings that start from its samples. The crossing of sample i along
  // `axis` is at kPerSample i + axis; where there is no crossing the entry is undefined.
  struct SampleRow {
    std::int32_t j = -1;
    std::int32_t k = -1;
    std::vector<std::uint32_t> numbers;
  };
  // For an edge: which of the four rows around a row of cells holds its lower end, and at which offset from the cell.
  struct Place {
    std::uint32_t row = 0;
    std::uint32_t offset = 0;
  };
  static constexpr std::size_t kPerSample = 4;

  void take_row(std::int32_t j, std::int32_t k);
  void number_row(SampleRow& row) const;

  const CrossingIndex& index_;
  std::array<Place, 12> places_;
  // Of even and odd layers of samples and, within these, of even and odd rows.
  std::array<std::array<SampleRow, 2>, 2> known_;
  std::array<std::int32_t, 2> row_{-1, -1};     // of cells: (j, k)
  std::array<const std::uint32_t*, 4> rows_{};  // around it: at (j, k), (j + 1, k), (j, k + 1) and (j + 1, k + 1)
  std::size_t first_ = 0;                       // where the numbers of the cell's lowest corner begin
};

}  // namespace deliso
