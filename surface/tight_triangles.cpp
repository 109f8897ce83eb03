#include "surface/tight_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace deliso {

namespace {

constexpr double kSmallest = 1;  // boxes smaller than this (mesh-space units) share a level
// Cells are numbered up to this far from the origin, which is what their keys have room for; beyond it they run
// together.
constexpr double kFarthest = 0x1p18 - 1;
// Where a box meets more cells than this, only those are looked at that blocks of eight along each axis hold; where it
// meets many blocks, all blocks are gone through. (A fourth of these numbers or four times as many take as long.)
constexpr double kFewCells = 64;
constexpr double kManyBlocks = 512;
constexpr int kBlockShift = 3;

// Of a number from 1 up, also an infinite one.
int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023; }

// 2^-level, for a level that triangles are kept at.
double scale_of(int level) { return 1 / static_cast<double>(std::uint64_t{1} << level); }

// std::floor, which may be a call, for numbers that an integer holds.
std::int32_t floored(double x) {
  const auto towards_zero = static_cast<std::int32_t>(x);
  return towards_zero - (towards_zero > x ? 1 : 0);
}

}  // namespace

int TightTriangles::level_of(const Box3& box) {
  const Vec3 size = box.size();
  return exponent_of(std::max({size.x, size.y, size.z, kSmallest})) + 1;
}

TightTriangles::FloatBox TightTriangles::rounded_outward(const Box3& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  FloatBox rounded;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rounded.low[axis] = static_cast<float>(box.low[axis]);
    rounded.high[axis] = static_cast<float>(box.high[axis]);
    if (rounded.low[axis] > box.low[axis]) rounded.low[axis] = std::nextafter(rounded.low[axis], -kInfinity);
    if (rounded.high[axis] < box.high[axis]) rounded.high[axis] = std::nextafter(rounded.high[axis], kInfinity);
  }
  return rounded;
}

bool TightTriangles::meet(const FloatBox& a, const FloatBox& b) {
  // All at once: which of the six fails cannot be foretold.
  unsigned all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all &= static_cast<unsigned>(a.low[axis] <= b.high[axis]) & static_cast<unsigned>(b.low[axis] <= a.high[axis]);
  }
  return all != 0;
}

double TightTriangles::Range::count() const {
  double count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) count *= high[axis] - low[axis] + 1.0;
  return count;
}

bool TightTriangles::Range::contains(const Place& place) const {
  bool all = true;
  for (std::size_t axis = 0; axis < 3; ++axis) all = all && low[axis] <= place[axis] && place[axis] <= high[axis];
  return all;
}

template <class Visit>
void TightTriangles::Range::for_each(Visit&& visit) const {
  for (std::int32_t z = low[2]; z <= high[2]; ++z) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t x = low[0]; x <= high[0]; ++x) visit(Place{x, y, z});
    }
  }
}

TightTriangles::Range TightTriangles::cells_of(const Box3& box, int level) {
  const double scale = scale_of(level);
  const auto place = [&](double x) { return floored(std::clamp(x * scale, -kFarthest, kFarthest)); };
  return {{place(box.low.x), place(box.low.y), place(box.low.z)},
          {place(box.high.x), place(box.high.y), place(box.high.z)}};
}

TightTriangles::Range TightTriangles::blocks_of(const Range& cells) {
  Range blocks;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks.low[axis] = cells.low[axis] >> kBlockShift;
    blocks.high[axis] = cells.high[axis] >> kBlockShift;
  }
  return blocks;
}

std::uint64_t TightTriangles::cell_key(int level, const Place& place) {
  constexpr std::uint64_t kBits = 0x7FFFF;
  const auto bits = [&](std::size_t axis) { return static_cast<std::uint64_t>(place[axis]) & kBits; };
  return static_cast<std::uint64_t>(level) << 57 | bits(2) << 38 | bits(1) << 19 | bits(0);
}

std::uint64_t TightTriangles::block_key(int level, const Place& place) {
  return std::uint64_t{1} << 63 | cell_key(level, place);
}

// Calls visit(cell) for those cells of a level that have been used, and maybe for others.
template <class Visit>
void TightTriangles::for_each_used_cell(const Range& cells, int level, Visit&& visit) const {
  const auto look_at = [&](const Place& place) { visit(cells_[place_of(cell_key(level, place))]); };
  if (cells.count() <= kFewCells) {
    cells.for_each(look_at);
    return;
  }
  const auto look_into = [&](const Place& block) {
    Range within;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t first = block[axis] << kBlockShift;
      within.low[axis] = std::max(cells.low[axis], first);
      within.high[axis] = std::min(cells.high[axis], first + (1 << kBlockShift) - 1);
    }
    within.for_each(look_at);
  };
  const Range blocks = blocks_of(cells);
  if (blocks.count() <= kManyBlocks) {
    blocks.for_each([&](const Place& block) {
      if (cells_[place_of(block_key(level, block))].key != kNoKey) look_into(block);
    });
    return;
  }
  for (const Place& block : blocks_[static_cast<std::size_t>(level)]) {
    if (blocks.contains(block)) look_into(block);
  }
}

// Where a key is, or the free place where it belongs.
std::size_t TightTriangles::place_of(std::uint64_t key) const {
  const std::size_t mask = cells_.size() - 1;
  std::size_t place = (key * 0x9E3779B97F4A7C15u) >> 32 & mask;
  while (cells_[place].key != key && cells_[place].key != kNoKey) place = (place + 1) & mask;
  return place;
}

// False when it is there already.
bool TightTriangles::insert(std::uint64_t key) {
  if (cells_[place_of(key)].key == key) return false;
  if (2 * ++used_ > cells_.size()) grow();
  cells_[place_of(key)].key = key;
  return true;
}

TightTriangles::Cell& TightTriangles::cell_at(int level, const Place& place) {
  const std::uint64_t key = cell_key(level, place);
  if (insert(key)) {
    const Place block = {place[0] >> kBlockShift, place[1] >> kBlockShift, place[2] >> kBlockShift};
    if (insert(block_key(level, block))) blocks_[static_cast<std::size_t>(level)].push_back(block);
  }
  return cells_[place_of(key)];
}

void TightTriangles::grow() {
  std::vector<Cell> old(4 * cells_.size());
  std::swap(old, cells_);
  for (Cell& cell : old) {
    if (cell.key != kNoKey) cells_[place_of(cell.key)] = std::move(cell);
  }
}

void TightTriangles::add(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  if (level >= kLevels) return;
  if (seen_.size() <= triangle) seen_.resize(triangle + 1, 0);
  seen_[triangle] = 1;
  ++kept_at_[static_cast<std::size_t>(level)];
  const Entry entry{rounded_outward(box), triangle};
  cells_of(box, level).for_each([&](const Place& place) { cell_at(level, place).entries.push_back(entry); });
}

void TightTriangles::remove(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  seen_[triangle] = 0;
  --kept_at_[static_cast<std::size_t>(level)];
  cells_of(box, level).for_each([&](const Place& cell) {
    auto& entries = cells_[place_of(cell_key(level, cell))].entries;
    std::size_t place = 0;
    while (place < entries.size() && entries[place].triangle != triangle) ++place;
    if (place == entries.size()) return;
    entries[place] = entries.back();
    entries.pop_back();
  });
}

void TightTriangles::append_near(const Box3& box, std::vector<std::uint32_t>& found) {
  ++search_;
  const FloatBox rounded = rounded_outward(box);
  for (int level = 0; level < kLevels; ++level) {
    if (kept_at_[static_cast<std::size_t>(level)] == 0) continue;
    for_each_used_cell(cells_of(box, level), level, [&](const Cell& cell) {
      const std::vector<Entry>& entries = cell.entries;
      // Which of them are found cannot be foretold: all are written, and what is not found is overwritten.
      std::size_t count = found.size();
      found.resize(count + entries.size());
      for (const Entry& entry : entries) {
        auto& seen = seen_[entry.triangle];
        const auto meets = static_cast<std::uint32_t>(meet(entry.box, rounded));
        const std::uint32_t change = (seen ^ search_) & (0u - meets);
        seen ^= change;
        found[count] = entry.triangle;
        count += static_cast<std::size_t>(change != 0);
      }
      found.resize(count);
    });
  }
}

}  // namespace deliso
