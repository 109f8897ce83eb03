#include "delaunay/spatial_order.h"

#include <array>
#include <bit>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/base/huge_pages.h"

namespace deliso {
namespace {

constexpr unsigned kBits = 16;      // of the Hilbert curve's grid, per axis
constexpr unsigned kRounds = 8;     // all but the last have an eighth of what is left
constexpr std::size_t kCrowd = 32;  // more points than this in one cell of the grid are sorted again
constexpr unsigned kDigit = 11;     // bits per pass of the radix sort
constexpr unsigned kKeyBits = 3 * kBits + 3;

struct KeyedPoint {
  std::uint64_t key;
  std::uint32_t index;
};

// The index of a grid cell along the Hilbert curve (Skilling: Programming the Hilbert curve, 2004).
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x) {
  // Undo the rotations and reflections, from the coarsest level down.
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (auto& coordinate : x) {
      const std::uint32_t flip = (coordinate & q) != 0 ? below : 0;
      const std::uint32_t swap = (coordinate & q) != 0 ? 0 : (x[0] ^ coordinate) & below;
      x[0] ^= flip | swap;
      coordinate ^= swap;
    }
  }
  // Gray encode.
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t parity = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    if ((x[2] & q) != 0) parity ^= q - 1;
  }
  // Interleave the bits.
  std::uint64_t index = 0;
  for (unsigned bit = kBits; bit-- > 0;) {
    for (const std::uint32_t coordinate : x) index = (index << 1) | (((coordinate ^ parity) >> bit) & 1u);
  }
  return index;
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
    for (KeyedPoint& item : items) {
      const Vec3& p = points_[item.index];
      const Vec3 cell = scale * (p - box.low);
      const std::uint64_t round = by_round ? round_of(p) : 0;
      item.key = (round << (3 * kBits)) |
                 hilbert_index({static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                static_cast<std::uint32_t>(cell.z)});
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
  // Sorts the points of each crowded cell again, over a box of their own.
  void sort_crowds(std::span<KeyedPoint> items) {
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
      const std::uint64_t key = items[begin].key;
      for (end = begin; end < items.size() && items[end].key == key;) ++end;
      if (end - begin > kCrowd && end - begin < items.size()) sort(items.subspan(begin, end - begin), false);
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
