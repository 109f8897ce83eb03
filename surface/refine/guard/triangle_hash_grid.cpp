#include "surface/refine/guard/triangle_hash_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/base/lane_bits.h"

namespace deliso {

namespace {

// Cells are numbered up to this far from the origin, because the keys have no room for more; cells beyond share the
// numbers of the outermost ones.
constexpr double kFarthest = 0x1p18 - 1;
// If a box meets more cells than this, only the cells in used blocks (eight cells along each axis) are visited; if it
// meets many blocks, all used blocks are visited. (A fourth or four times of these numbers take the same time.)
constexpr double kFewCells = 64;
constexpr double kManyBlocks = 512;
constexpr int kBlockShift = 3;

// The exponent of a normal number above zero, or of infinity.
int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023; }

// std::floor for numbers in the range of an integer; std::floor itself may be a function call.
std::int32_t floored(double x) {
  const auto towards_zero = static_cast<std::int32_t>(x);
  return towards_zero - (towards_zero > x ? 1 : 0);
}

}  // namespace

TriangleHashGrid::TriangleHashGrid(double edge) {
  constexpr int kFinest = 8;
  for (; finer_ < kFinest && smallest_ > 2 * edge; smallest_ /= 2) ++finer_;
}

int TriangleHashGrid::level_of(const Box3& box) const {
  const Vec3 size = box.size();
  return exponent_of(std::max({size.x, size.y, size.z, smallest_})) + finer_ + 2;
}

// What turns lengths into cells of a level.
double TriangleHashGrid::scale_of(int level) const {
  return std::bit_cast<double>(std::uint64_t(1023 + finer_ - level) << 52);
}

TriangleHashGrid::FloatBox::FloatBox(const Box3& box)
    : low{static_cast<float>(box.low.x), static_cast<float>(box.low.y), static_cast<float>(box.low.z)},
      high{static_cast<float>(box.high.x), static_cast<float>(box.high.y), static_cast<float>(box.high.z)} {}

TriangleHashGrid::Row::Row() {
  for (std::size_t i = 0; i < kPerRow; ++i) clear(i);
}

void TriangleHashGrid::Row::set(std::size_t i, std::uint32_t triangle, const FloatBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis][i] = box.low[axis];
    high[axis][i] = box.high[axis];
  }
  triangles[i] = triangle;
}

void TriangleHashGrid::Row::set(std::size_t i, const Row& from, std::size_t j) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis][i] = from.low[axis][j];
    high[axis][i] = from.high[axis][j];
  }
  triangles[i] = from.triangles[j];
}

void TriangleHashGrid::Row::clear(std::size_t i) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis][i] = std::numeric_limits<float>::infinity();
    high[axis][i] = -std::numeric_limits<float>::infinity();
  }
  triangles[i] = kNone;
}

std::uint32_t TriangleHashGrid::Row::meeting(const FloatBox& other) const {
  return bits_where<kPerRow>([&](std::size_t i) {
    std::uint32_t all = ~0U;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all &= mask_of(low[axis][i] <= other.high[axis]) & mask_of(other.low[axis] <= high[axis][i]);
    }
    return all;
  });
}

std::size_t TriangleHashGrid::Row::count() const {
  return static_cast<std::size_t>(std::find(triangles.begin(), triangles.end(), kNone) - triangles.begin());
}

double TriangleHashGrid::Range::count() const {
  double count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) count *= high[axis] - low[axis] + 1.0;
  return count;
}

bool TriangleHashGrid::Range::contains(const Place& place) const {
  bool all = true;
  for (std::size_t axis = 0; axis < 3; ++axis) all = all && low[axis] <= place[axis] && place[axis] <= high[axis];
  return all;
}

template <class Visit>
void TriangleHashGrid::Range::for_each(Visit&& visit) const {
  for (std::int32_t z = low[2]; z <= high[2]; ++z) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t x = low[0]; x <= high[0]; ++x) visit(Place{x, y, z});
    }
  }
}

TriangleHashGrid::Place TriangleHashGrid::place_of(const Vec3& point, int level) const {
  const double scale = scale_of(level);
  const auto place = [&](double x) { return floored(std::clamp(x * scale, -kFarthest, kFarthest)); };
  return {place(point.x), place(point.y), place(point.z)};
}

// The cells that may hold the low corners of the boxes that meet `box`: such a box is smaller than half a cell.
TriangleHashGrid::Range TriangleHashGrid::cells_near(const Box3& box, int level) const {
  const double half = 0.5 / scale_of(level);
  return {place_of(box.low - Vec3{half, half, half}, level), place_of(box.high, level)};
}

TriangleHashGrid::Range TriangleHashGrid::blocks_of(const Range& cells) {
  Range blocks;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks.low[axis] = cells.low[axis] >> kBlockShift;
    blocks.high[axis] = cells.high[axis] >> kBlockShift;
  }
  return blocks;
}

std::uint64_t TriangleHashGrid::cell_key(int level, const Place& place) {
  constexpr std::uint64_t kBits = 0x7FFFF;
  const auto bits = [&](std::size_t axis) { return static_cast<std::uint64_t>(place[axis]) & kBits; };
  return static_cast<std::uint64_t>(level) << 57 | bits(2) << 38 | bits(1) << 19 | bits(0);
}

std::uint64_t TriangleHashGrid::block_key(int level, const Place& place) {
  return std::uint64_t{1} << 63 | cell_key(level, place);
}

// Calls visit(cell) for all used cells of a range at a level, and possibly for others.
template <class Visit>
void TriangleHashGrid::for_each_used_cell(const Range& cells, int level, Visit&& visit) const {
  const auto look_at = [&](const Place& place) { visit(cells_[slot_of(cell_key(level, place))]); };
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
      if (cells_[slot_of(block_key(level, block))].key != kNoKey) look_into(block);
    });
    return;
  }
  for (const Place& block : blocks_[static_cast<std::size_t>(level)]) {
    if (blocks.contains(block)) look_into(block);
  }
}

// The slot of a key, or the free slot where it belongs.
std::size_t TriangleHashGrid::slot_of(std::uint64_t key) const {
  const std::size_t mask = cells_.size() - 1;
  std::size_t slot = (key * 0x9E3779B97F4A7C15u) >> 32 & mask;
  while (cells_[slot].key != key && cells_[slot].key != kNoKey) slot = (slot + 1) & mask;
  return slot;
}

// Returns false when the key is present already; then `slot` is its slot.
bool TriangleHashGrid::insert(std::uint64_t key, std::size_t& slot) {
  slot = slot_of(key);
  if (cells_[slot].key == key) return false;
  if (2 * ++used_ > cells_.size()) {
    grow();
    slot = slot_of(key);
  }
  cells_[slot].key = key;
  return true;
}

TriangleHashGrid::Cell& TriangleHashGrid::cell_at(int level, const Place& place) {
  const std::uint64_t key = cell_key(level, place);
  std::size_t slot = 0, of_block = 0;
  if (insert(key, slot)) {
    const Place block = {place[0] >> kBlockShift, place[1] >> kBlockShift, place[2] >> kBlockShift};
    if (insert(block_key(level, block), of_block)) blocks_[static_cast<std::size_t>(level)].push_back(block);
    slot = slot_of(key);  // adding the block may have resized the table
  }
  return cells_[slot];
}

void TriangleHashGrid::grow() {
  std::vector<Cell> old(4 * cells_.size());
  std::swap(old, cells_);
  for (Cell& cell : old) {
    if (cell.key != kNoKey) cells_[slot_of(cell.key)] = std::move(cell);
  }
}

void TriangleHashGrid::add(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  if (level >= kLevels) return;
  if (held_.size() <= triangle) held_.resize(triangle + 1, 0);
  held_[triangle] = 1;
  ++kept_at_[static_cast<std::size_t>(level)];
  levels_ |= std::uint64_t{1} << level;
  auto& rows = cell_at(level, place_of(box.low, level)).rows;
  if (rows.empty() || rows.back().count() == kPerRow) rows.emplace_back();
  rows.back().set(rows.back().count(), triangle, FloatBox(box));
}

void TriangleHashGrid::remove(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  held_[triangle] = 0;
  if (--kept_at_[static_cast<std::size_t>(level)] == 0) levels_ &= ~(std::uint64_t{1} << level);
  auto& rows = cells_[slot_of(cell_key(level, place_of(box.low, level)))].rows;
  for (Row& row : rows) {
    const auto place = std::find(row.triangles.begin(), row.triangles.end(), triangle);
    if (place == row.triangles.end()) continue;
    // The last triangle takes its slot.
    const std::size_t last = rows.back().count() - 1;
    row.set(static_cast<std::size_t>(place - row.triangles.begin()), rows.back(), last);
    rows.back().clear(last);
    if (last == 0) rows.pop_back();
    return;
  }
}

void TriangleHashGrid::append_near(const Box3& box, std::vector<std::uint32_t>& found) const {
  const FloatBox rounded(box);
  for (std::uint64_t levels = levels_; levels != 0; levels &= levels - 1) {
    const int level = std::countr_zero(levels);
    for_each_used_cell(cells_near(box, level), level, [&](const Cell& cell) {
      if (cell.rows.empty()) return;
      // Which of them are found is unpredictable: all are written, and those not found are overwritten.
      std::size_t count = found.size();
      found.resize(count + kPerRow * cell.rows.size());
      for (const Row& row : cell.rows) {
        const std::uint32_t bits = row.meeting(rounded);
        for (std::size_t i = 0; i < kPerRow; ++i) {
          found[count] = row.triangles[i];
          count += bits >> i & 1;
        }
      }
      found.resize(count);
    });
  }
}

}  // namespace deliso
