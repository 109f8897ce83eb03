#include "raycast/active_cells.h"

#include <algorithm>
#include <bit>

#include "volume/sample_sides.h"

namespace deliso {

namespace {

using Word = std::uint64_t;
constexpr std::size_t kWordBits = kSidesPerWord;

// The signs of all samples, in rows of whole words.
struct SampleSigns {
  std::size_t words_per_row = 0;
  std::size_t rows_per_slice = 0;
  std::vector<Word> words;

  SampleSigns(const ScalarGrid& grid, double isovalue) {
    const auto n = static_cast<std::size_t>(grid.dims()[0]);
    words_per_row = n / kWordBits + 1;  // one spare bit: extended cells outnumber samples by one
    rows_per_slice = static_cast<std::size_t>(grid.dims()[1]);
    const std::size_t rows = rows_per_slice * static_cast<std::size_t>(grid.dims()[2]);
    words.resize(rows * words_per_row);
    visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& samples) {
      const SideTest<Sample> sides(isovalue);
      for (std::size_t row = 0; row < rows; ++row) sides.pack(samples.data() + row * n, n, &words[row * words_per_row]);
    });
  }
  [[nodiscard]] const Word* row(std::int32_t j, std::int32_t k) const {
    return words.data() + words_per_row * (static_cast<std::size_t>(j) + rows_per_slice * static_cast<std::size_t>(k));
  }
};

// Active bits of a row of extended cells from the four rows of samples around it.
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

}  // namespace

ActiveCells::ActiveCells(const ScalarGrid& grid, double isovalue) {
  const Dims& n = grid.dims();
  // A coordinate's low two bits tell the place in a brick, the third the brick in a line, the rest the line.
  std::size_t line_stride = 512;
  for (std::size_t a = 0; a < 3; ++a) {
    places_[a].resize(static_cast<std::size_t>(n[a]) + 1);
    for (std::size_t c = 0; c < places_[a].size(); ++c)
      places_[a][c] = ((c & 3) << (2 * a)) + (((c >> 2) & 1) << (6 + a)) + (c >> 3) * line_stride;
    line_stride *= (static_cast<std::size_t>(n[a]) >> 3) + 1;
  }
  words_.assign(line_stride / 64, 0);
  const SampleSigns signs(grid, isovalue);
  std::vector<Word> active(signs.words_per_row);
  for (std::int32_t z = 0; z <= n[2]; ++z)
    for (std::int32_t y = 0; y <= n[1]; ++y) {
      const std::int32_t j0 = std::max(y - 1, 0);
      const std::int32_t j1 = std::min(y, n[1] - 1);
      const std::int32_t k0 = std::max(z - 1, 0);
      const std::int32_t k1 = std::min(z, n[2] - 1);
      activate_row({signs.row(j0, k0), signs.row(j1, k0), signs.row(j0, k1), signs.row(j1, k1)},
                   static_cast<std::size_t>(n[0]), active);
      // Deal the row out to its bricks, four cells each.
      for (std::size_t word = 0; word < active.size(); ++word) {
        std::int32_t x = static_cast<std::int32_t>(word * kWordBits);
        for (Word left = active[word]; left != 0; left >>= 4, x += 4) {
          if ((left & 15u) == 0) continue;
          const std::size_t place = place_of({x, y, z});
          words_[place / kWordBits] |= (left & 15u) << (place % kWordBits);
        }
      }
    }
}

bool ActiveCells::any_active(const Cell& low, const Cell& high) const {
  // Bits of a brick whose coordinates along an axis lie in [first, last]; first is at most 3, last at least 0.
  const auto mask = [](std::size_t axis, std::int32_t first, std::int32_t last) {
    constexpr std::array<Word, 3> kRun = {0xFu, 0xFFFFu, ~Word{0}};  // where the coordinate goes from 0 to 3 once
    constexpr std::array<Word, 3> kRepeat = {0x1111111111111111u, 0x0001000100010001u, 1};
    const auto bits = [axis](std::int32_t cells) { return static_cast<unsigned>(cells) << (2 * axis); };
    const Word from_first = kRun[axis] << bits(std::max(first, 0));
    const Word to_last = kRun[axis] >> bits(3 - std::min(last, 3));
    return (from_first & to_last) * kRepeat[axis];
  };
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

std::size_t ActiveCells::count() const {
  std::size_t cells = 0;
  for (const Word word : words_) cells += static_cast<std::size_t>(std::popcount(word));
  return cells;
}

}  // namespace deliso
