// The numbers of the crossings on the edges of cells that are gone through row by row.
//
// CrossingIndex::number() counts bits for every edge. Here a row of samples is gone through once, and each of its
// crossings takes the number after the one before it; the rows around a row of cells serve the next one, too.
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

  // To a cell. Fast where it lies in the same row along x as the last one, or in the next row along y.
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
  // A row of samples and the numbers of the crossings that start from its samples: of sample i along `axis` at
  // kPerSample i + axis. Where there is no crossing, there is no telling.
  struct SampleRow {
    std::int32_t j = -1;
    std::int32_t k = -1;
    std::vector<std::uint32_t> numbers;
  };
  // Of an edge: which of the four rows around a row of cells its lower end is in, and where, seen from the cell.
  struct Place {
    std::uint32_t row = 0;
    std::uint32_t offset = 0;
  };
  static constexpr std::size_t kPerSample = 4;

  void take_row(std::int32_t j, std::int32_t k);
  void number_row(SampleRow& row) const;

  const CrossingIndex& index_;
  std::array<Place, 12> places_;
  std::array<std::array<SampleRow, 2>, 2> known_;  // of layers of samples and, within these, of rows: even and odd ones
  std::array<std::int32_t, 2> row_{-1, -1};        // of cells: (j, k)
  std::array<const std::uint32_t*, 4> rows_{};     // around it: at (j, k), (j + 1, k), (j, k + 1) and (j + 1, k + 1)
  std::size_t first_ = 0;                          // of the numbers of the cell's lowest corner
};

}  // namespace deliso
