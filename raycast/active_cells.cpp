#include "raycast/active_cells.h"

#include <algorithm>
#include <bit>

#include "delaunay/base/parallel.h"
#include "volume/sample_sides.h"

namespace deliso {

namespace {

using Word = std::uint64_t;
constexpr std::size_t kWordBits = kSidesPerWord;
// The number of layers that a thread takes at a time: whole bricks, so that no two threads write to the same word.
constexpr std::size_t kSlabLayers = 32;

// The signs of all samples, in rows of whole words.
struct SampleSigns {
  std::size_t words_per_row = 0;
  std::size_t rows_per_slice = 0;
  UnwrittenArray<Word> words;

  SampleSigns(const ScalarGrid& grid, double isovalue, int threads) {
    const auto n = static_cast<std::size_t>(grid.dims()[0]);
    words_per_row = n / kWordBits + 1;  // one spare bit: extended cells outnumber samples by one
    rows_per_slice = static_cast<std::size_t>(grid.dims()[1]);
    const std::size_t rows = rows_per_slice * static_cast<std::size_t>(grid.dims()[2]);
    words.resize(rows * words_per_row);
    visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& samples) {
      const SideTest<Sample> sides(isovalue);
      const std::size_t rows_per_slab = rows_per_slice * kSlabLayers;
      run_tasks((rows + rows_per_slab - 1) / rows_per_slab, threads, [&](std::size_t slab) {
        const std::size_t last = std::min(rows, (slab + 1) * rows_per_slab);
        for (std::size_t row = slab * rows_per_slab; row < last; ++row) {
          words[(row + 1) * words_per_row - 1] = 0;
          sides.pack(samples.data() + row * n, n, &words[row * words_per_row]);
        }
      });
    });
  }
  [[nodiscard]] const Word* row(std::int32_t j, std::int32_t k) const {
    return words.data() + words_per_row * (static_cast<std::size_t>(j) + rows_per_slice * static_cast<std::size_t>(k));
  }
};

// The active bits of a row of extended cells, from the four rows of samples around it.
void activate_row(const std::array<const Word*, 4>& rows, std::size_t samples, std::vector<Word>& active) {
  Word any_carry = 0;  // last bit of the word before
  Word all_carry = 1;
  for (std::size_t w = 0; w < active.size(); ++w) {
    const Word any = rows[0][w] | rows[1][w] | rows[2][w] | rows[3][w];
    Word all = rows[0][w] & rows[1][w] & rows[2][w] & rows[3][w];
    // Cell e has samples e - 1 and e; cells 0 and n have only one of the two.
    if (w == samples / kWordBits) all |= Word{1} << (samples % kWordBits);
    active[w] = (any | (any << 1) | any_carry) & ~(all & ((all << 1) | all_carry));
    any_carry = any >> (kWordBits - 1);
    all_carry = all >> (kWordBits - 1);
  }
}

// Bits of a brick whose coordinate along an axis is at least, or at most, so much.
using BrickMasks = std::array<std::array<Word, 4>, 3>;
constexpr BrickMasks brick_masks(bool is_least) {
  BrickMasks masks{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t bound = 0; bound < 4; ++bound)
      for (std::size_t bit = 0; bit < kWordBits; ++bit) {
        const std::size_t c = (bit >> (2 * axis)) & 3;
        if (is_least ? c >= bound : c <= bound) masks[axis][bound] |= Word{1} << bit;
      }
  return masks;
}
constexpr BrickMasks kFrom = brick_masks(true);
constexpr BrickMasks kTo = brick_masks(false);

// Bits of a brick whose coordinate along an axis lies in [first, last]; first is at most 3, last at least 0.
Word mask(std::size_t axis, std::int32_t first, std::int32_t last) {
  return kFrom[axis][static_cast<std::size_t>(std::max(first, 0))] &
         kTo[axis][static_cast<std::size_t>(std::min(last, 3))];
}

}  // namespace

ActiveCells::ActiveCells(const ScalarGrid& grid, double isovalue, int threads) {
  const Dims& n = grid.dims();
  // The low two bits of a coordinate give the position in a brick, the third bit the brick in a cache line, the rest
  // the cache line.
  std::size_t line_stride = 512;
  for (std::size_t a = 0; a < 3; ++a) {
    places_[a].resize(static_cast<std::size_t>(n[a]) + 1);
    for (std::size_t c = 0; c < places_[a].size(); ++c)
      places_[a][c] = ((c & 3) << (2 * a)) + (((c >> 2) & 1) << (6 + a)) + (c >> 3) * line_stride;
    line_stride *= (static_cast<std::size_t>(n[a]) >> 3) + 1;
  }
  words_.resize(line_stride / kWordBits);
  const std::size_t words_per_eight_layers = words_.size() / ((static_cast<std::size_t>(n[2]) >> 3) + 1);
  const SampleSigns signs(grid, isovalue, threads);
  const std::size_t layers = places_[2].size();
  run_tasks((layers + kSlabLayers - 1) / kSlabLayers, threads, [&](std::size_t slab) {
    std::vector<Word> active(signs.words_per_row);
    const auto last = static_cast<std::int32_t>(std::min(layers, (slab + 1) * kSlabLayers));
    const std::size_t first_eight = slab * kSlabLayers / 8, last_eight = (static_cast<std::size_t>(last) + 7) / 8;
    std::fill_n(words_.data() + first_eight * words_per_eight_layers,
                (last_eight - first_eight) * words_per_eight_layers, Word{0});
    for (auto z = static_cast<std::int32_t>(slab * kSlabLayers); z < last; ++z) {
      for (std::int32_t y = 0; y <= n[1]; ++y) {
        const std::int32_t j0 = std::max(y - 1, 0), j1 = std::min(y, n[1] - 1);
        const std::int32_t k0 = std::max(z - 1, 0), k1 = std::min(z, n[2] - 1);
        activate_row({signs.row(j0, k0), signs.row(j1, k0), signs.row(j0, k1), signs.row(j1, k1)},
                     static_cast<std::size_t>(n[0]), active);
        deal_out(active, y, z);
      }
    }
  });
}

// Distributes the bits of a row of cells to its bricks, four cells to each.
void ActiveCells::deal_out(const std::vector<std::uint64_t>& active, std::int32_t y, std::int32_t z) {
  for (std::size_t word = 0; word < active.size(); ++word) {
    auto x = static_cast<std::int32_t>(word * kWordBits);
    for (Word left = active[word]; left != 0; left >>= 4, x += 4) {
      if ((left & 15u) == 0) continue;
      const std::size_t place = place_of({x, y, z});
      words_[place / kWordBits] |= (left & 15u) << (place % kWordBits);
    }
  }
}

bool ActiveCells::any_active(const Cell& low, const Cell& high) const {
  const auto bricks = [&](std::size_t axis) { return (high[axis] >> 2) - (low[axis] >> 2); };
  return (bricks(0) | bricks(1) | bricks(2)) <= 1 ? any_active_of_eight(low, high) : any_active_of_many(low, high);
}

bool ActiveCells::any_active_of_many(const Cell& low, const Cell& high) const {
  for (std::int32_t z = low[2] & ~3; z <= high[2]; z += 4) {
    const Word in_z = mask(2, low[2] - z, high[2] - z);
    for (std::int32_t y = low[1] & ~3; y <= high[1]; y += 4) {
      const Word in_yz = in_z & mask(1, low[1] - y, high[1] - y);
      for (std::int32_t x = low[0] & ~3; x <= high[0]; x += 4)
        if ((brick({x, y, z}) & in_yz & mask(0, low[0] - x, high[0] - x)) != 0) return true;
    }
  }
  return false;
}

// For a box that meets at most two bricks along every axis. How many it meets is unpredictable, so eight bricks are
// always read, some of them twice.
bool ActiveCells::any_active_of_eight(const Cell& low, const Cell& high) const {
  std::array<std::array<std::size_t, 2>, 3> bricks;  // what each coordinate contributes to the number of a word
  std::array<std::array<Word, 2>, 3> masks;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int32_t first = low[a] & ~3, second = high[a] & ~3;
    bricks[a] = {places_[a][static_cast<std::size_t>(first)] / kWordBits,
                 places_[a][static_cast<std::size_t>(second)] / kWordBits};
    const Word from_low = kFrom[a][static_cast<std::size_t>(low[a] & 3)];
    const Word to_high = kTo[a][static_cast<std::size_t>(high[a] & 3)];
    const Word any_in_two = Word{0} - static_cast<Word>(first != second);  // the other end is in the other brick
    masks[a] = {from_low & (to_high | any_in_two), to_high & (from_low | any_in_two)};
  }
  const auto row = [&](std::size_t y, std::size_t z) {
    const Word* const words = words_.data() + bricks[1][y] + bricks[2][z];
    return ((words[bricks[0][0]] & masks[0][0]) | (words[bricks[0][1]] & masks[0][1])) & masks[1][y] & masks[2][z];
  };
  return (row(0, 0) | row(1, 0) | row(0, 1) | row(1, 1)) != 0;
}

std::size_t ActiveCells::count() const {
  std::size_t cells = 0;
  for (const Word word : words_) cells += static_cast<std::size_t>(std::popcount(word));
  return cells;
}

}  // namespace deliso
