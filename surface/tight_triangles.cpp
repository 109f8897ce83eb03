#include "surface/tight_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace deliso {

namespace {

constexpr double kSmallest = 1;  // boxes smaller than this (mesh-space units) share a level
// Cells are numbered up to this far from the origin; beyond it they run together.
constexpr double kFarthest = 1e9;
constexpr double kManyCells = 4096;

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

// The cells of a level that a box meets; when they are very many, those that have been used instead.
template <class Visit>
void TightTriangles::for_each_key(const Box3& box, int level, Visit&& visit) const {
  double count = 1;
  std::array<std::int32_t, 3> low{}, high{};
  const double scale = scale_of(level);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = [&](double x) { return floored(std::clamp(x * scale, -kFarthest, kFarthest)); };
    low[axis] = place(box.low[axis]);
    high[axis] = place(box.high[axis]);
    count *= high[axis] - low[axis] + 1.0;
  }
  if (count > kManyCells) {
    std::vector<std::uint64_t> keys;
    for (const Cell& cell : cells_) {
      if (cell.key != kNoKey && cell.key >> 57 == static_cast<std::uint64_t>(level)) keys.push_back(cell.key);
    }
    for (const std::uint64_t key : keys) visit(key);
    return;
  }
  constexpr std::uint64_t kBits = 0x7FFFF;
  for (std::int32_t z = low[2]; z <= high[2]; ++z) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t x = low[0]; x <= high[0]; ++x) {
        visit(static_cast<std::uint64_t>(level) << 57 | (static_cast<std::uint64_t>(z) & kBits) << 38 |
              (static_cast<std::uint64_t>(y) & kBits) << 19 | (static_cast<std::uint64_t>(x) & kBits));
      }
    }
  }
}

// Where a key is, or the free place where it belongs.
std::size_t TightTriangles::place_of(std::uint64_t key) const {
  const std::size_t mask = cells_.size() - 1;
  std::size_t place = (key * 0x9E3779B97F4A7C15u) >> 32 & mask;
  while (cells_[place].key != key && cells_[place].key != kNoKey) place = (place + 1) & mask;
  return place;
}

TightTriangles::Cell& TightTriangles::cell_at(std::uint64_t key) {
  std::size_t place = place_of(key);
  if (cells_[place].key == kNoKey) {
    if (2 * ++used_ > cells_.size()) {
      grow();
      place = place_of(key);
    }
    cells_[place].key = key;
  }
  return cells_[place];
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
  for_each_key(box, level, [&](std::uint64_t key) { cell_at(key).entries.push_back(entry); });
}

void TightTriangles::remove(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  seen_[triangle] = 0;
  --kept_at_[static_cast<std::size_t>(level)];
  for_each_key(box, level, [&](std::uint64_t key) {
    auto& entries = cells_[place_of(key)].entries;
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
    for_each_key(box, level, [&](std::uint64_t key) {
      const auto& entries = cells_[place_of(key)].entries;
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
