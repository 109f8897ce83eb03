#include "delaunay/spatial_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/base/huge_pages.h"

namespace deliso {
namespace {

constexpr unsigned kBits = 16;      // of the Hilbert curve's grid, per axis
constexpr unsigned kRounds = 8;     // each takes about seven times as many points as all before it
constexpr std::size_t kCrowd = 32;  // a cell of the grid with more points than this is sorted again
constexpr unsigned kDigit = 11;     // bits per pass of the radix sort
constexpr unsigned kKeyBits = 3 * kBits + 3;

struct KeyedPoint {
  std::uint64_t key;
  std::uint32_t index;
};

// Grid cells handled together, coordinate by coordinate, so that the compiler can vectorize the loops.
constexpr std::size_t kTogether = 8;
using Cells = std::array<std::array<std::uint32_t, kTogether>, 3>;

// Puts two zeros between neighbouring bits of x, which has 16.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 16) & 0xFF0000FFull;
  x = (x | x << 8) & 0xF00F00F00Full;
  x = (x | x << 4) & 0xC30C30C30C3ull;
  return (x | x << 2) & 0x249249249249ull;
}

// The indices of grid cells along the Hilbert curve (Skilling: Programming the Hilbert curve, 2004).
std::array<std::uint64_t, kTogether> hilbert_indices(Cells x) {
  // Undo the rotations and reflections, from the coarsest level down.
  for (unsigned bit = kBits - 1; bit > 0; --bit) {
    const std::uint32_t below = (1u << bit) - 1;
    for (std::size_t i = 0; i < kTogether; ++i) x[0][i] ^= below & (0u - ((x[0][i] >> bit) & 1u));
    for (const unsigned axis : {1u, 2u}) {
      for (std::size_t i = 0; i < kTogether; ++i) {
        const std::uint32_t flip = below & (0u - ((x[axis][i] >> bit) & 1u));
        const std::uint32_t swap = (x[0][i] ^ x[axis][i]) & (below ^ flip);
        x[0][i] ^= flip | swap;
        x[axis][i] ^= swap;
      }
    }
  }
  // Gray encode, and interleave the bits.
  std::array<std::uint64_t, kTogether> indices{};
  for (std::size_t i = 0; i < kTogether; ++i) {
    const std::uint32_t y = x[1][i] ^ x[0][i];
    const std::uint32_t z = x[2][i] ^ y;
    std::uint32_t parity = z >> 1;  // of the bits above each
    for (const unsigned by : {1u, 2u, 4u, 8u}) parity ^= parity >> by;
    indices[i] = (spread_bits(x[0][i] ^ parity) << 2) | (spread_bits(y ^ parity) << 1) | spread_bits(z ^ parity);
  }
  return indices;
}

// 0 for the first round, kRounds - 1 for the last.
std::uint64_t round_of(const Vec3& p) {
  std::uint64_t hash = 0;
  for (const double coordinate : {p.x, p.y, p.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9E3779B97F4A7C15ull;  // + 0.0: -0 equals 0
    hash ^= hash >> 32;
  }
  hash *= 0xD6E8FEB86659FD93ull;
  const auto skipped = static_cast<unsigned>(std::countl_zero(hash)) / 3;
  return kRounds - 1 - std::min(skipped, kRounds - 1);
}

// Stable.
void radix_sort(std::span<KeyedPoint> items, LargeArray<KeyedPoint>& buffer) {
  buffer.resize(items.size());
  std::span<KeyedPoint> from = items;
  std::span<KeyedPoint> to = buffer;
  for (unsigned shift = 0; shift < kKeyBits; shift += kDigit) {
    std::array<std::uint32_t, 1u << kDigit> starts{};
    const auto digit = [shift](const KeyedPoint& item) { return (item.key >> shift) & ((1u << kDigit) - 1); };
    for (const KeyedPoint& item : from) ++starts[digit(item)];
    std::uint32_t sum = 0;
    for (auto& start : starts) sum += std::exchange(start, sum);
    for (const KeyedPoint& item : from) to[starts[digit(item)]++] = item;
    std::swap(from, to);
  }
  if (from.data() != items.data()) std::copy(from.begin(), from.end(), items.begin());
}

class Sorter {
 public:
  explicit Sorter(std::span<const Vec3> points) : points_(points) {}

  // Sorts by round, if asked for, and along the curve over the box of the items.
  void sort(std::span<KeyedPoint> items, bool by_round) {
    Box3 box;
    for (const KeyedPoint& item : items) box.extend(points_[item.index]);
    const Vec3 size = box.size();
    const double side = std::max({size.x, size.y, size.z});
    if (!(side > 0)) return;  // all equal
    const double scale = ((1u << kBits) - 1) / side;
    for (std::size_t begin = 0; begin < items.size(); begin += kTogether) {
      const auto group = items.subspan(begin, std::min(kTogether, items.size() - begin));
      Cells cells{};
      for (std::size_t i = 0; i < group.size(); ++i) {
        const Vec3 cell = scale * (points_[group[i].index] - box.low);
        for (unsigned axis = 0; axis < 3; ++axis) cells[axis][i] = static_cast<std::uint32_t>(cell[axis]);
      }
      const auto indices = hilbert_indices(cells);
      for (std::size_t i = 0; i < group.size(); ++i) {
        const std::uint64_t round = by_round ? round_of(points_[group[i].index]) : 0;
        group[i].key = (round << (3 * kBits)) | indices[i];
      }
    }
    if (items.size() > 256) {
      radix_sort(items, buffer_);
    } else {
      std::stable_sort(items.begin(), items.end(),
                       [](const KeyedPoint& a, const KeyedPoint& b) { return a.key < b.key; });
    }
    sort_crowds(items);
  }

 private:
  // Sorts the points of each crowded cell again, over a box of their own; in others brings equal points together.
  void sort_crowds(std::span<KeyedPoint> items) {
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
      const std::uint64_t key = items[begin].key;
      for (end = begin; end < items.size() && items[end].key == key;) ++end;
      const auto cell = items.subspan(begin, end - begin);
      if (cell.size() <= kCrowd) {
        join_equals(cell);
      } else if (cell.size() < items.size()) {
        sort(cell, false);
      }
    }
  }

  // Moves points up to those that they equal; the order stays as it is otherwise.
  void join_equals(std::span<KeyedPoint> cell) {
    for (std::size_t next = 1; next + 1 < cell.size(); ++next) {
      const Vec3& p = points_[cell[next - 1].index];
      for (auto equal = cell.begin() + static_cast<std::ptrdiff_t>(next); equal != cell.end(); ++equal) {
        if (points_[equal->index] != p) continue;
        std::rotate(cell.begin() + static_cast<std::ptrdiff_t>(next), equal, equal + 1);
        break;
      }
    }
  }

  std::span<const Vec3> points_;
  LargeArray<KeyedPoint> buffer_;
};

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points) {
  LargeArray<KeyedPoint> items(points.size());
  for (std::size_t i = 0; i < items.size(); ++i) items[i].index = static_cast<std::uint32_t>(i);
  Sorter(points).sort(items, true);
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

}  // namespace deliso
