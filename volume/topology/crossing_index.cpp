#include "volume/topology/crossing_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "delaunay/base/check.h"
#include "volume/sample_sides.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// Marks the samples of a row above the isovalue; false when a sample equals it.
template <class Sample>
bool mark_row(const SideTest<Sample>& sides, const Sample* row, std::size_t length, std::uint64_t* words) {
  sides.pack(row, length, words);
  return sides.never_equal() || std::none_of(row, row + length, [&](Sample sample) { return sides.equals(sample); });
}

// How many bits of three words are set: summed by pairs, fours and bytes within each word, then over all bytes. (Not
// every processor has an instruction for this.)
unsigned count_bits(const std::array<std::uint64_t, 3>& words) {
  std::uint64_t bytes = 0;
  for (std::uint64_t word : words) {
    word -= word >> 1 & 0x5555555555555555u;
    word = (word & 0x3333333333333333u) + (word >> 2 & 0x3333333333333333u);
    bytes += (word + (word >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
  }
  return static_cast<unsigned>(bytes * 0x0101010101010101u >> 56);
}

}  // namespace

double edge_parameter(double low, double high, double isovalue) {
  double before = low - isovalue;
  double length = low - high;
  if (!std::isfinite(before) || !std::isfinite(length)) {
    before = low / 2 - isovalue / 2;
    length = low / 2 - high / 2;
  }
  constexpr double kBelowOne = 1 - std::numeric_limits<double>::epsilon() / 2;
  return std::clamp(before / length, std::numeric_limits<double>::min(), kBelowOne);
}

CrossingIndex::CrossingIndex(const ScalarGrid& grid, double isovalue, int threads)
    : dims_(grid.dims()), words_per_row_((grid.dims()[0] + kWordBits - 1) / kWordBits) {
  const std::size_t rows = static_cast<std::size_t>(dims_[1]) * static_cast<std::size_t>(dims_[2]);
  above_.resize(rows * static_cast<std::size_t>(words_per_row_));
  first_in_word_.resize(above_.size());

  // Mark the samples above the isovalue, a row at a time.
  std::vector<std::uint8_t> regular(slab_count(dims_[2]), 1);  // of each slab
  std::visit(
      [&]<class Sample>(const SampleArray<Sample>& samples) {
        const SideTest<Sample> sides(isovalue);
        const auto length = static_cast<std::size_t>(dims_[0]);
        const auto words = static_cast<std::size_t>(words_per_row_);
        const auto row_of = [&](std::int32_t k) {
          return static_cast<std::size_t>(dims_[1]) * static_cast<std::size_t>(k);
        };
        for_each_slab(dims_[2], threads, [&](std::size_t slab, std::int32_t first, std::int32_t last) {
          for (std::size_t row = row_of(first); row < row_of(last); ++row) {
            if (!mark_row(sides, samples.data() + row * length, length, &above_[row * words])) regular[slab] = 0;
          }
        });
      },
      grid.samples());
  DELISO_CHECK(std::find(regular.begin(), regular.end(), 0) == regular.end(), "no sample equals the isovalue");

  // Count the crossings before every word: within its slab, then in all.
  std::vector<std::uint64_t> before(slab_count(dims_[2]) + 1, 0);  // each slab
  for_each_slab(dims_[2], threads, [&](std::size_t slab, std::int32_t first, std::int32_t last) {
    before[slab + 1] = count_in_layers(first, last);
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  if (before.back() >= kNone) {
    throw InputError("the isosurface crosses " + std::to_string(before.back()) + " grid edges, expected fewer than " +
                     std::to_string(kNone));
  }
  crossing_count_ = static_cast<std::uint32_t>(before.back());
  for_each_slab(dims_[2], threads, [&](std::size_t slab, std::int32_t first, std::int32_t last) {
    const auto shift = static_cast<std::uint32_t>(before[slab]);
    for (std::size_t i = word_index(0, 0, first); i < word_index(0, 0, last); ++i) first_in_word_[i] += shift;
  });
}

// Numbers the crossings of some layers of samples from 0; returns how many there are.
std::uint64_t CrossingIndex::count_in_layers(std::int32_t first, std::int32_t last) {
  std::uint64_t count = 0;
  for (std::int32_t k = first; k < last; ++k) {
    for (std::int32_t j = 0; j < dims_[1]; ++j) {
      for (std::int32_t w = 0; w < words_per_row_; ++w) {
        first_in_word_[word_index(w, j, k)] = static_cast<std::uint32_t>(count);
        const std::array<std::uint64_t, 3> bits = crossed(w, j, k);
        if ((bits[0] | bits[1] | bits[2]) != 0) count += count_bits(bits);
      }
    }
  }
  return count;
}

std::uint32_t CrossingIndex::find(std::int32_t i, std::int32_t j, std::int32_t k, int axis) const {
  if (i < 0 || j < 0 || k < 0 || i >= dims_[0] || j >= dims_[1] || k >= dims_[2]) return kNone;
  const std::uint64_t bits = crossed(i / kWordBits, j, k)[static_cast<std::size_t>(axis)];
  return (bits >> (i % kWordBits) & 1u) != 0 ? number(i, j, k, axis) : kNone;
}

std::uint32_t CrossingIndex::number(std::int32_t i, std::int32_t j, std::int32_t k, int axis) const {
  const std::int32_t w = i / kWordBits;
  const std::uint64_t here = std::uint64_t{1} << (i % kWordBits);
  std::array<std::uint64_t, 3> bits = crossed(w, j, k);
  for (int a = 0; a < 3; ++a) {
    // Edges of earlier samples, and this sample's edges along lower axes.
    bits[static_cast<std::size_t>(a)] &= (here - 1) | (a < axis ? here : 0);
  }
  return first_in_word_[word_index(w, j, k)] + count_bits(bits);
}

std::uint32_t CrossingIndex::number(const CellIndex& cell, int edge) const {
  const CellEdge e = cell_edge(edge);
  return number(cell[0] + (e.corner & 1), cell[1] + (e.corner >> 1 & 1), cell[2] + (e.corner >> 2), e.axis);
}

UnwrittenArray<EdgeCrossing> list_crossings(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                            int threads) {
  UnwrittenArray<EdgeCrossing> crossings(index.crossing_count());
  const std::array<std::size_t, 3> stride{1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
  const auto list_word = [&](const auto& samples, std::int32_t w, std::int32_t j, std::int32_t k) {
    const std::array<std::uint64_t, 3> crossed = index.crossed(w, j, k);
    std::size_t number = index.first_number(w, j, k);
    for (std::uint64_t left = crossed[0] | crossed[1] | crossed[2]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const std::size_t sample = grid.index(w * CrossingIndex::kWordBits + bit, j, k);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((crossed[axis] >> bit & 1u) == 0) continue;
        const auto low = static_cast<double>(samples[sample]);
        const auto high = static_cast<double>(samples[sample + stride[axis]]);
        crossings[number++] = {sample, static_cast<std::uint8_t>(axis), 0, edge_parameter(low, high, isovalue)};
      }
    }
  };
  std::visit(
      [&](const auto& samples) {
        for_each_slab(grid.dims()[2], threads, [&](std::size_t, std::int32_t first, std::int32_t last) {
          for (std::int32_t k = first; k < last; ++k) {
            for (std::int32_t j = 0; j < grid.dims()[1]; ++j) {
              for (std::int32_t w = 0; w < index.words_per_row(); ++w) list_word(samples, w, j, k);
            }
          }
        });
      },
      grid.samples());
  return crossings;
}

CellIndex sample_of(const EdgeCrossing& crossing, const Dims& dims) {
  const auto nx = static_cast<std::uint64_t>(dims[0]), ny = static_cast<std::uint64_t>(dims[1]);
  const std::uint64_t row = crossing.sample / nx;
  return {static_cast<std::int32_t>(crossing.sample % nx), static_cast<std::int32_t>(row % ny),
          static_cast<std::int32_t>(row / ny)};
}

Vec3 crossing_position(const ScalarGrid& grid, const EdgeCrossing& crossing) {
  const auto [i, j, k] = sample_of(crossing, grid.dims());
  // The axis is unpredictable, so there is no branch on it: a table adds zero along the other axes (compilers turn
  // conditional expressions into branches).
  static constexpr std::array<Vec3, 3> kAlong = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  return Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} +
         crossing.t * kAlong[crossing.axis];
}

}  // namespace deliso
