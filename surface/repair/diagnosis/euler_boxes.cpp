#include "surface/repair/diagnosis/euler_boxes.h"

namespace deliso {

namespace {

// Jumps nearer to each other than this form one range: Euler curves err by a few layers.
constexpr std::int32_t kCloseLayers = 4;
// How many layers a change may lie outside of a box and yet be added to its sum.
constexpr std::int32_t kBoxMargin = 4;

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

std::optional<EulerBoxes> EulerBoxes::around(const std::array<std::vector<std::int32_t>, 3>& jumps,
                                             const std::array<std::int32_t, 3>& dims, std::size_t most) {
  EulerBoxes boxes;
  for (std::size_t axis = 0; axis < 3; ++axis) boxes.ranges_[axis] = ranges_of(jumps[axis]);
  if (boxes.count() == 0 || boxes.count() > most) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<LayerRange>& ranges = boxes.ranges_[axis];
    Near near;
    for (std::int32_t layer = 0; layer < dims[axis]; ++layer) {
      while (near.end < ranges.size() && ranges[near.end].first - kBoxMargin <= layer) ++near.end;
      while (near.begin < near.end && ranges[near.begin].last + kBoxMargin < layer) ++near.begin;
      boxes.near_[axis].push_back(near);
    }
  }
  boxes.sums_.assign(boxes.count(), 0);
  return boxes;
}

void EulerBoxes::add(const SampleLayers& layers, std::int32_t change) {
  const auto near = [&](std::size_t axis) { return near_[axis][static_cast<std::size_t>(layers[axis])]; };
  for (std::size_t z = near(2).begin; z < near(2).end; ++z) {
    for (std::size_t y = near(1).begin; y < near(1).end; ++y) {
      for (std::size_t x = near(0).begin; x < near(0).end; ++x) {
        sums_[x + ranges_[0].size() * (y + ranges_[1].size() * z)] += change;
      }
    }
  }
}

IndexRanges EulerBoxes::boxes() const {
  IndexRanges boxes;
  for (const LayerRange& z : ranges_[2]) {
    for (const LayerRange& y : ranges_[1]) {
      for (const LayerRange& x : ranges_[0]) {
        if (sums_[boxes.all.size()] != 0) boxes.likely.push_back({x, y, z});
        boxes.all.push_back({x, y, z});
      }
    }
  }
  if (boxes.likely.empty()) boxes.likely = boxes.all;
  return boxes;
}

}  // namespace deliso
