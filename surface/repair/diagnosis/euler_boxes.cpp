#include "surface/repair/diagnosis/euler_boxes.h"

#include <algorithm>

namespace deliso {

namespace {

// Layers nearer than this (as sweeps err by some) belong together.
constexpr std::int32_t kCloseLayers = 4;
// From a place to the sides of the smallest box, in layers.
constexpr std::int32_t kSmallest = 4;
constexpr std::size_t kMostBoxes = 1u << 13;

std::vector<LayerRange> ranges_of(const std::vector<std::int32_t>& layers) {
  std::vector<LayerRange> ranges;
  for (const std::int32_t layer : layers) {
    if (!ranges.empty() && layer - ranges.back().last < kCloseLayers) {
      ranges.back().last = layer;
    } else {
      ranges.push_back({layer, layer});
    }
  }
  return ranges;
}

}  // namespace

std::optional<EulerBoxes> EulerBoxes::around(const std::array<std::vector<std::int32_t>, 3>& layers,
                                             const std::array<std::int32_t, 3>& dims) {
  EulerBoxes boxes;
  for (std::size_t axis = 0; axis < 3; ++axis) boxes.ranges_[axis] = ranges_of(layers[axis]);
  if (boxes.count() == 0 || boxes.count() > kMostBoxes) return std::nullopt;
  for (std::size_t size = 0; size < kSizes; ++size) {
    const std::int32_t reach = kSmallest + static_cast<std::int32_t>(size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<LayerRange>& ranges = boxes.ranges_[axis];
      Near near;
      for (std::int32_t layer = 0; layer < dims[axis]; ++layer) {
        while (near.end < ranges.size() && ranges[near.end].first - reach <= layer) ++near.end;
        while (near.begin < near.end && ranges[near.begin].last + reach < layer) ++near.begin;
        boxes.near_[size][axis].push_back(near);
      }
    }
    boxes.sums_[size].assign(boxes.count(), 0);
  }
  return boxes;
}

void EulerBoxes::add(const std::array<std::int32_t, 3>& layers, std::int32_t amount) {
  if (!reach(0, layers[0]) || !reach(1, layers[1]) || !reach(2, layers[2])) return;
  for (std::size_t size = 0; size < kSizes; ++size) {
    const auto near = [&](std::size_t axis) { return near_[size][axis][static_cast<std::size_t>(layers[axis])]; };
    for (std::size_t z = near(2).begin; z < near(2).end; ++z) {
      for (std::size_t y = near(1).begin; y < near(1).end; ++y) {
        for (std::size_t x = near(0).begin; x < near(0).end; ++x) {
          sums_[size][x + ranges_[0].size() * (y + ranges_[1].size() * z)] += amount;
        }
      }
    }
  }
}

IndexRanges EulerBoxes::places() const {
  IndexRanges places;
  std::size_t box = 0;
  for (const LayerRange& z : ranges_[2]) {
    for (const LayerRange& y : ranges_[1]) {
      for (const LayerRange& x : ranges_[0]) {
        places.all.push_back({x, y, z});
        if (differs(box++)) places.likely.push_back({x, y, z});
      }
    }
  }
  if (places.likely.empty()) places.likely = places.all;
  return places;
}

bool EulerBoxes::differs(std::size_t box) const {
  std::array<std::int32_t, kSizes> votes{};
  for (std::size_t size = 0; size < kSizes; ++size) votes[size] = sums_[size][box];
  std::nth_element(votes.begin(), votes.begin() + kSizes / 2, votes.end());
  return votes[kSizes / 2] != 0;
}

}  // namespace deliso
