#include "volume/topology/cell_crossings.h"

#include <bit>

#include "volume/topology/cell_sweep.h"

namespace deliso {

CellCrossings::CellCrossings(const CrossingIndex& index) : index_(index) {
  for (int edge = 0; edge < kCellEdges; ++edge) {
    const auto [corner, axis] = cell_edge(edge);
    places_[static_cast<std::size_t>(edge)] = {
        static_cast<std::uint32_t>(corner >> 1),
        static_cast<std::uint32_t>(corner & 1) * static_cast<std::uint32_t>(kPerSample) +
            static_cast<std::uint32_t>(axis)};
  }
}

void CellCrossings::take_row(std::int32_t j, std::int32_t k) {
  row_ = {j, k};
  for (std::int32_t near = 0; near < 4; ++near) {
    const std::int32_t at_j = j + (near & 1);
    const std::int32_t at_k = k + (near >> 1);
    SampleRow& row = known_[static_cast<std::size_t>(at_k % 2)][static_cast<std::size_t>(at_j % 2)];
    if (row.j != at_j || row.k != at_k) {
      row.j = at_j;
      row.k = at_k;
      number_row(row);
    }
    rows_[static_cast<std::size_t>(near)] = row.numbers.data();
  }
}

void CellCrossings::number_row(SampleRow& row) const {
  row.numbers.resize(kPerSample * static_cast<std::size_t>(index_.dims()[0]));
  for (std::int32_t w = 0; w < index_.words_per_row(); ++w) {
    const std::array<std::uint64_t, 3> crossed = index_.crossed(w, row.j, row.k);
    std::uint32_t number = index_.first_number(w, row.j, row.k);
    std::uint32_t* const numbers = &row.numbers[kPerSample * static_cast<std::size_t>(w * CrossingIndex::kWordBits)];
    for (std::uint64_t left = crossed[0] | crossed[1] | crossed[2]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      std::uint32_t* const at = numbers + kPerSample * static_cast<std::size_t>(bit);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] = number;
        number += static_cast<std::uint32_t>(crossed[axis] >> bit & 1u);
      }
    }
  }
}

}  // namespace deliso
