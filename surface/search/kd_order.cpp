#include "surface/search/kd_order.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "delaunay/base/parallel.h"

namespace deliso {

namespace {

using Places = std::span<LatticePlace>;

constexpr int kPartDepth = 4;       // parts of this depth are tasks
constexpr unsigned kIndexBits = 5;  // at most 2^this things are split by counting
constexpr std::size_t kSmall = std::size_t{1} << kIndexBits;
constexpr std::size_t kMostSamples = 32;
constexpr int kMostRounds = 24;

// An axis, and where the positions begin and how far they reach along it.
struct Extent {
  std::size_t axis = 0;
  std::int32_t low = 0;
  std::uint32_t size = 0;
};

Extent longest_side(Places places) {
  std::array<std::int32_t, 3> low = places[0].at, high = low;
  for (const LatticePlace& p : places) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p.at[k]);
      high[k] = std::max(high[k], p.at[k]);
    }
  }
  Extent longest;
  for (std::size_t k = 3; k-- > 0;) {
    const auto size = static_cast<std::uint32_t>(high[k] - low[k]);
    if (size >= longest.size) longest = {k, low[k], size};
  }
  return longest;
}

// Positions with equal steps are ordered by their thing, so that the order is total.
std::uint64_t key(const LatticePlace& p, std::size_t axis) {
  return std::uint64_t{static_cast<std::uint32_t>(p.at[axis])} << 32 | p.thing;
}

// For few positions: each moves to the index that is the number of positions before it. They are compared by the
// uppermost bits of their coordinate above the least one, then by their present index.
void part_few(Places places, const Extent& extent) {
  const int width = static_cast<int>(std::bit_width(extent.size)), most = 31 - static_cast<int>(kIndexBits);
  const int shift = std::max(width - most, 0);
  std::array<std::int32_t, kSmall> keys, before{};
  keys.fill(std::numeric_limits<std::int32_t>::max());
  std::array<LatticePlace, kSmall> old;
  for (std::size_t i = 0; i < places.size(); ++i) {
    old[i] = places[i];
    keys[i] = (((old[i].at[extent.axis] - extent.low) >> shift) << kIndexBits) + static_cast<std::int32_t>(i);
  }
  for (std::size_t j = 0; j < places.size(); ++j) {
    const std::int32_t one = keys[j];
    for (std::size_t i = 0; i < kSmall; ++i) before[i] += one < keys[i] ? 1 : 0;
  }
  for (std::size_t i = 0; i < places.size(); ++i) places[static_cast<std::size_t>(before[i])] = old[i];
}

// A key that about `middle` positions precede: the key at the same rank within a sample of them.
std::uint64_t pivot_key(Places places, std::size_t middle, std::size_t axis) {
  const std::size_t count = std::min(kMostSamples, places.size() / 8), stride = places.size() / count;
  std::array<std::uint64_t, kMostSamples> samples{};
  for (std::size_t i = 0; i < count; ++i) samples[i] = key(places[i * stride + stride / 2], axis);
  const auto rank = samples.begin() + static_cast<std::ptrdiff_t>(count * middle / places.size());
  std::nth_element(samples.begin(), rank, samples.begin() + static_cast<std::ptrdiff_t>(count));
  return *rank;
}

// Moves the positions with smaller keys to the front; returns how many. No branches, because which these are is
// unpredictable.
std::size_t move_smaller(Places places, std::uint64_t bound, std::size_t axis) {
  std::size_t smaller = 0;
  for (LatticePlace& p : places) {
    const LatticePlace current = p;
    p = places[smaller];
    places[smaller] = current;
    smaller += key(current, axis) < bound ? 1 : 0;
  }
  return smaller;
}

// A crowded set of positions must span this many steps along its longest side; otherwise its order is refined.
constexpr std::uint32_t kFewestSteps = 1u << 10;
constexpr std::size_t kCrowd = 256;

using CentreOf = std::function<Vec3(std::uint32_t)>;

// Gives the things of a crowded set positions on a finer lattice of their own.
Extent spread_out(Places places, const CentreOf& centre_of) {
  Box3 box;
  for (const LatticePlace& p : places) box.extend(centre_of(p.thing));
  const CentreLattice lattice(box);
  for (LatticePlace& p : places) p = lattice.place(centre_of(p.thing), p.thing);
  return longest_side(places);
}

// Moves to the front the `middle` positions that come first along the longest side.
void part(Places places, std::size_t middle, const CentreOf& centre_of) {
  Extent extent = longest_side(places);
  if (places.size() > kCrowd && extent.size < kFewestSteps) extent = spread_out(places, centre_of);
  for (int round = 0; places.size() > kSmall; ++round) {
    const std::size_t smaller = move_smaller(places, pivot_key(places, middle, extent.axis), extent.axis);
    if (smaller == middle) return;
    if (smaller == 0 || round == kMostRounds) {
      std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(middle), places.end(),
                       [&](const auto& a, const auto& b) { return key(a, extent.axis) < key(b, extent.axis); });
      return;
    }
    if (middle < smaller) {
      places = places.first(smaller);
    } else {
      places = places.subspan(smaller);
      middle -= smaller;
    }
  }
  part_few(places, extent);
}

void order(Places places, const CentreOf& centre_of) {
  while (places.size() > kThingsPerLeaf) {
    const std::size_t middle = left_half(static_cast<std::uint32_t>(places.size()));
    part(places, middle, centre_of);
    order(places.first(middle), centre_of);
    places = places.subspan(middle);
  }
}

}  // namespace

CentreLattice::CentreLattice(const Box3& box) : low_(box.low) {
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  // Sides too short to count steps in are treated as zero.
  if (longest > 1e-290) steps_per_unit_ = kMostSteps / longest;
}

std::uint32_t left_half(std::uint32_t count) {
  return std::bit_floor((count + kThingsPerLeaf - 1) / kThingsPerLeaf - 1) * kThingsPerLeaf;
}

std::vector<std::uint32_t> kd_order(std::vector<LatticePlace> places, const CentreOf& centre_of, int threads) {
  // First the uppermost levels one by one, then the subtrees below them.
  std::vector<Places> parts = {places};
  for (int depth = 0; depth < kPartDepth; ++depth) {
    std::vector<Places> halves(2 * parts.size());
    run_tasks(parts.size(), threads, [&](std::size_t i) {
      const Places whole = parts[i];
      const std::size_t middle =
          whole.size() > kThingsPerLeaf ? left_half(static_cast<std::uint32_t>(whole.size())) : whole.size();
      if (middle < whole.size()) part(whole, middle, centre_of);
      halves[2 * i] = whole.first(middle);
      halves[2 * i + 1] = whole.subspan(middle);
    });
    parts = std::move(halves);
  }
  run_tasks(parts.size(), threads, [&](std::size_t i) { order(parts[i], centre_of); });
  std::vector<std::uint32_t> things;
  things.reserve(places.size());
  for (const LatticePlace& p : places) things.push_back(p.thing);
  return things;
}

}  // namespace deliso
