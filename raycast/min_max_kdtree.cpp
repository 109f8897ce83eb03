#include "raycast/min_max_kdtree.h"

#include <algorithm>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

std::size_t index_of(std::int32_t value) { return static_cast<std::size_t>(value); }

}  // namespace

void MinMaxKdTree::lay_out(std::int32_t leaf_cells) {
  // Halve the longest side until single cells are left; levels from the root down.
  std::array<int, 3> shift{};
  for (std::size_t a = 0; a < 3; ++a) shift[a] = bit_width(cells_[a] - 1);
  std::vector<Level> downward;
  for (;;) {
    Level level;
    level.shift = shift;
    for (std::size_t a = 0; a < 3; ++a) level.dims[a] = (index_of(cells_[a] - 1) >> shift[a]) + 1;
    downward.push_back(level);
    const auto longest = std::max_element(shift.begin(), shift.end());
    if (*longest == 0) break;
    --*longest;
    level_of_bit_[index_of(static_cast<std::int32_t>(longest - shift.begin()))][index_of(*longest)] =
        static_cast<std::int8_t>(downward.size());  // counted from the root for now
  }
  levels_.assign(downward.rbegin(), downward.rend());
  for (auto& bits : level_of_bit_)
    for (auto& level : bits) level = static_cast<std::int8_t>(root_level() + 1 - level);
  // Count the nodes of the leaf level and of all levels that are stored.
  leaf_level_ = std::min(bit_width(leaf_cells) - 1, root_level());
  std::size_t first = 0;
  for (int l = std::max(leaf_level_, 1); l <= root_level(); ++l) {
    Level& level = levels_[index_of(l)];
    level.first = first;
    first += level.dims[0] * level.dims[1] * level.dims[2];
  }
}

namespace {

// One bound of the ranges (the minima or the maxima) for all levels, bottom-up.
template <class Sample, class Better>
class RangeBuilder {
 public:
  RangeBuilder(const SampleArray<Sample>& samples, const Dims& dims, Better better)
      : samples_(samples), dims_(dims), better_(better) {}

  // The lowest kept level, straight from the samples.
  template <class Level>
  void from_samples(const Level& level, Sample* out) {
    const std::size_t row = index_of(dims_[0]);
    std::vector<Sample> best(row);
    for (std::size_t z = 0; z < level.dims[2]; ++z)
      for (std::size_t y = 0; y < level.dims[1]; ++y) {
        // First over the rows of samples of this row of nodes, then along x.
        const auto [j0, j1] = sample_range(level, 1, y);
        const auto [k0, k1] = sample_range(level, 2, z);
        std::copy_n(samples_.data() + row * (j0 + index_of(dims_[1]) * k0), row, best.data());
        for (std::size_t k = k0; k <= k1; ++k)
          for (std::size_t j = j0; j <= j1; ++j)
            take(best.data(), samples_.data() + row * (j + index_of(dims_[1]) * k), row);
        for (std::size_t x = 0; x < level.dims[0]; ++x) {
          const auto [i0, i1] = sample_range(level, 0, x);
          Sample value = best[i0];
          for (std::size_t i = i0 + 1; i <= i1; ++i) value = better_(best[i], value);
          *out++ = value;
        }
      }
  }

  // A level from the one below, which is twice as fine along one axis.
  template <class Level>
  void from_below(const Level& below, const Level& level, const Sample* in, Sample* out) {
    const std::size_t nx = level.dims[0];
    const std::size_t halve_y = index_of(level.shift[1] - below.shift[1]);
    const std::size_t halve_z = index_of(level.shift[2] - below.shift[2]);
    for (std::size_t z = 0; z < level.dims[2]; ++z)
      for (std::size_t y = 0; y < level.dims[1]; ++y, out += nx) {
        const Sample* a = in + below.dims[0] * ((y << halve_y) + below.dims[1] * (z << halve_z));
        if (below.dims[0] != nx || level.shift[0] != below.shift[0]) {
          join_pairs(a, below.dims[0], out);
          continue;
        }
        std::copy_n(a, nx, out);
        if (halve_y != 0 && 2 * y + 1 < below.dims[1]) take(out, a + nx, nx);
        if (halve_z != 0 && 2 * z + 1 < below.dims[2]) take(out, a + nx * below.dims[1], nx);
      }
  }

 private:
  // First and last sample of the cells of node i of an axis.
  template <class Level>
  [[nodiscard]] std::pair<std::size_t, std::size_t> sample_range(const Level& level, std::size_t a,
                                                                 std::size_t i) const {
    return {i << level.shift[a], std::min((i + 1) << level.shift[a], index_of(dims_[a]) - 1)};
  }
  void take(Sample* best, const Sample* other, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) best[i] = better_(other[i], best[i]);
  }
  void join_pairs(const Sample* in, std::size_t count, Sample* out) {
    for (std::size_t i = 0; i < count / 2; ++i) out[i] = better_(in[2 * i + 1], in[2 * i]);
    if (count % 2 != 0) out[count / 2] = in[count - 1];
  }

  const SampleArray<Sample>& samples_;
  const Dims& dims_;
  Better better_;
};

}  // namespace

MinMaxKdTree::MinMaxKdTree(const ScalarGrid& grid, std::int32_t leaf_cells) : dims_(grid.dims()) {
  DELISO_CHECK(leaf_cells >= 1, "a kd-tree leaf holds at least one cell");
  for (std::size_t a = 0; a < 3; ++a) cells_[a] = dims_[a] - 1;
  lay_out(leaf_cells);
  const auto lowest = index_of(std::max(leaf_level_, 1));
  const bool has_nodes = lowest < levels_.size();
  const std::size_t nodes = has_nodes ? levels_.back().first + 1 : 0;
  visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& samples) {
    const auto build = [&](auto better) {
      std::vector<Sample> best(nodes);
      RangeBuilder builder(samples, dims_, better);
      if (has_nodes) builder.from_samples(levels_[lowest], best.data());
      for (std::size_t l = lowest + 1; l < levels_.size(); ++l)
        builder.from_below(levels_[l - 1], levels_[l], best.data() + levels_[l - 1].first,
                           best.data() + levels_[l].first);
      return best;
    };
    low_ = build([](Sample a, Sample b) { return a < b ? a : b; });
    high_ = build([](Sample a, Sample b) { return a > b ? a : b; });
  });
}

CellBlock MinMaxKdTree::block(int level, const Cell& cell) const {
  CellBlock block;
  for (std::size_t a = 0; a < 3; ++a) {
    const int shift = levels_[index_of(level)].shift[a];
    const std::int32_t low = (cell[a] >> shift) << shift;
    const std::int64_t high = std::int64_t{low} + (std::int64_t{1} << shift) - 1;
    block.low[a] = low == 0 ? 0 : low + 1;
    block.high[a] = high >= cells_[a] - 1 ? dims_[a] : static_cast<std::int32_t>(high) + 1;
  }
  return block;
}

std::size_t MinMaxKdTree::bytes() const {
  return visit_samples(low_, [](const auto& low) { return 2 * low.size() * sizeof(low[0]); });
}

}  // namespace deliso
