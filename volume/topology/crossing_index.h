// Which grid edges the isosurface crosses. One bit per sample is stored; the number of a crossing is found in constant
// time.
//
// "Index space" has sample (i, j, k) at the point (i, j, k).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "delaunay/base/huge_pages.h"
#include "delaunay/base/parallel.h"
#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A sign change along the grid edge from `sample` (linear index of its lower end) towards +axis.
struct EdgeCrossing {
  std::uint64_t sample = 0;
  std::uint8_t axis = 0;        // 0 x, 1 y, 2 z
  std::uint32_t component = 0;  // index into IsosurfaceTopology::components
  double t = 0;                 // position along the edge, in (0, 1)
};

// Where the field equals `isovalue` on a segment between two values on different sides of it, as a fraction of the
// segment in (0, 1). Every crossing of a grid edge is computed here, from the lower sample to the higher, so that equal
// crossings are equal bit by bit.
double edge_parameter(double low, double high, double isovalue);

// A voxel cell, by its lowest corner; or a sample.
using CellIndex = std::array<std::int32_t, 3>;
// The sample that a crossing's edge starts from.
CellIndex sample_of(const EdgeCrossing& crossing, const Dims& dims);

// The number of layers across z that a thread takes at a time. It does not depend on the number of threads, and the
// results of slabs are joined in order; so results do not depend on the number of threads.
inline constexpr std::int32_t kSlabLayers = 8;
inline std::size_t slab_count(std::int32_t layers) {
  return layers > 0 ? static_cast<std::size_t>((layers - 1) / kSlabLayers + 1) : 0;
}
// Calls body(slab, first, last) for all slabs of the layers below `layers`; the slab's layers are first to last - 1.
template <class Body>
void for_each_slab(std::int32_t layers, int threads, Body&& body) {
  run_tasks(slab_count(layers), threads, [&](std::size_t slab) {
    const std::int32_t first = static_cast<std::int32_t>(slab) * kSlabLayers;
    body(slab, first, first + std::min(layers - first, kSlabLayers));
  });
}

// Crossings are numbered in (sample, axis) order: by the linear index of the edge's lower sample, then by axis.
// Memory: 1.5 bits per sample.
class CrossingIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  static constexpr int kWordBits = 64;

  CrossingIndex() = default;
  // Precondition: no sample equals `isovalue`. (Checked.) The same for any number of threads.
  CrossingIndex(const ScalarGrid& grid, double isovalue, int threads = 1);

  [[nodiscard]] const Dims& dims() const { return dims_; }
  [[nodiscard]] std::uint32_t crossing_count() const { return crossing_count_; }
  // Whether the sample lies above the isovalue.
  [[nodiscard]] bool above(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return (word(i / kWordBits, j, k) >> (i % kWordBits) & 1u) != 0;
  }
  // The number of the crossing on the edge from sample (i, j, k) towards +axis, or kNone when the edge has no crossing
  // or leaves the grid. Constant time.
  [[nodiscard]] std::uint32_t find(std::int32_t i, std::int32_t j, std::int32_t k, int axis) const;
  // The same for an edge that is known to have a crossing.
  [[nodiscard]] std::uint32_t number(std::int32_t i, std::int32_t j, std::int32_t k, int axis) const;
  // The same for an edge of a cell (cell_sweep.h).
  [[nodiscard]] std::uint32_t number(const CellIndex& cell, int edge) const;

  // Calls visit(number) for the crossings on the edges of a cell, those along x first, then those along y.
  template <class Visit>
  void for_each_crossing_of_cell(const CellIndex& cell, const Visit& visit) const;

  // Rows along x in words of 64 samples, for callers that walk all of them; bits beyond the row are zero.
  [[nodiscard]] std::int32_t words_per_row() const { return words_per_row_; }
  [[nodiscard]] std::uint64_t word(std::int32_t w, std::int32_t j, std::int32_t k) const {
    return above_[word_index(w, j, k)];
  }
  // The word of the samples one step further in x: bit b tells of sample 64 w + b + 1.
  [[nodiscard]] std::uint64_t next_word(std::int32_t w, std::int32_t j, std::int32_t k) const {
    const std::size_t index = word_index(w, j, k);
    const std::uint64_t carry = w + 1 < words_per_row_ ? above_[index + 1] << (kWordBits - 1) : 0;
    return above_[index] >> 1 | carry;
  }
  // Bits of the samples of a word that have a right neighbour in the row.
  [[nodiscard]] std::uint64_t cells_in_word(std::int32_t w) const {
    const std::int32_t left = dims_[0] - 1 - w * kWordBits;
    return left >= kWordBits ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
  }
  // Bits of the samples of a word whose edge towards +axis has a crossing.
  [[nodiscard]] std::array<std::uint64_t, 3> crossed(std::int32_t w, std::int32_t j, std::int32_t k) const {
    const std::uint64_t here = word(w, j, k);
    return {(here ^ next_word(w, j, k)) & cells_in_word(w), j + 1 < dims_[1] ? here ^ word(w, j + 1, k) : 0,
            k + 1 < dims_[2] ? here ^ word(w, j, k + 1) : 0};
  }

  // The number of the first crossing from the samples of a word or of any later one.
  [[nodiscard]] std::uint32_t first_number(std::int32_t w, std::int32_t j, std::int32_t k) const {
    return first_in_word_[word_index(w, j, k)];
  }

  // Calls visit(cell, pattern) for the cells whose corners do not all lie on one side, x fastest. Bit c of the pattern
  // is set when corner c lies above the isovalue.
  template <class Visit>
  void for_each_active_cell(const Visit& visit) const {
    for_each_active_cell(0, cell_layers(), visit);
  }
  // The same for the layers of cells from first_layer to last_layer - 1, of cell_layers() across z.
  template <class Visit>
  void for_each_active_cell(std::int32_t first_layer, std::int32_t last_layer, const Visit& visit) const;
  [[nodiscard]] std::int32_t cell_layers() const { return dims_[2] - 1; }
  // The same for a row of cells along x, of cell_rows() in a layer.
  template <class Visit>
  void for_each_active_cell_in_row(std::int32_t j, std::int32_t k, const Visit& visit) const {
    for (std::int32_t w = 0; w < words_per_row_; ++w) visit_active_cells_in_word(w, j, k, visit);
  }
  [[nodiscard]] std::int32_t cell_rows() const { return dims_[1] - 1; }

 private:
  std::uint64_t count_in_layers(std::int32_t first, std::int32_t last);
  template <class Visit>
  void visit_active_cells_in_word(std::int32_t w, std::int32_t j, std::int32_t k, const Visit& visit) const;
  [[nodiscard]] std::size_t word_index(std::int32_t w, std::int32_t j, std::int32_t k) const {
    return static_cast<std::size_t>(w) +
           static_cast<std::size_t>(words_per_row_) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(dims_[1]) * static_cast<std::size_t>(k));
  }

  Dims dims_{};
  std::int32_t words_per_row_ = 0;
  std::uint32_t crossing_count_ = 0;
  UnwrittenArray<std::uint64_t> above_;          // word (w, j, k) -> bits of its samples above the isovalue
  UnwrittenArray<std::uint32_t> first_in_word_;  // word (w, j, k) -> number of the first crossing from its samples
};

// The crossings in the order of their numbers; their components are left 0. The same for any number of threads.
UnwrittenArray<EdgeCrossing> list_crossings(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                            int threads = 1);

// The crossing's position in index space.
Vec3 crossing_position(const ScalarGrid& grid, const EdgeCrossing& crossing);

// --- Implementation -------------------------------------------------------------------------------------------------

template <class Visit>
void CrossingIndex::for_each_crossing_of_cell(const CellIndex& cell, const Visit& visit) const {
  for (std::int32_t edge = 0; edge < 12; ++edge) {
    const auto axis = static_cast<std::size_t>(edge / 4);
    CellIndex sample = cell;
    sample[(axis + 1) % 3] += edge & 1;
    sample[(axis + 2) % 3] += edge >> 1 & 1;
    const std::uint32_t crossing = find(sample[0], sample[1], sample[2], static_cast<int>(axis));
    if (crossing != kNone) visit(crossing);
  }
}

template <class Visit>
void CrossingIndex::for_each_active_cell(std::int32_t first_layer, std::int32_t last_layer, const Visit& visit) const {
  for (std::int32_t k = first_layer; k < last_layer; ++k) {
    for (std::int32_t j = 0; j < cell_rows(); ++j) for_each_active_cell_in_row(j, k, visit);
  }
}

template <class Visit>
void CrossingIndex::visit_active_cells_in_word(std::int32_t w, std::int32_t j, std::int32_t k,
                                               const Visit& visit) const {
  // Bit b of corners[c]: corner c of the word's b-th cell lies above the isovalue.
  std::array<std::uint64_t, 8> corners;
  std::uint64_t any = 0;
  std::uint64_t all = ~std::uint64_t{0};
  for (std::size_t row = 0; row < 4; ++row) {
    const auto dj = static_cast<std::int32_t>(row & 1);
    const auto dk = static_cast<std::int32_t>(row >> 1);
    corners[2 * row] = word(w, j + dj, k + dk);
    corners[2 * row + 1] = next_word(w, j + dj, k + dk);
    any |= corners[2 * row] | corners[2 * row + 1];
    all &= corners[2 * row] & corners[2 * row + 1];
  }
  for (std::uint64_t active = any & ~all & cells_in_word(w); active != 0; active &= active - 1) {
    const int bit = std::countr_zero(active);
    unsigned pattern = 0;
    for (std::size_t c = 0; c < 8; ++c) pattern |= static_cast<unsigned>(corners[c] >> bit & 1u) << c;
    visit(CellIndex{w * kWordBits + bit, j, k}, static_cast<std::uint8_t>(pattern));
  }
}

}  // namespace deliso
