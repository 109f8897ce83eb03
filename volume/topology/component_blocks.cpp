#include "volume/topology/component_blocks.h"

#include <algorithm>
#include <cmath>

#include "volume/topology/crossing_index.h"

namespace deliso {

namespace {

constexpr std::int32_t kSide = 8;  // of a block, in samples

}  // namespace

// A point in a block is looked up in its cell or, on a plane of samples, in the cells beside it. So it may be found on
// grid edges that start at any sample from the one before the block to the one after it.
ComponentBlocks::ComponentBlocks(const Dims& dims, const IsosurfaceTopology& topology) : dims_(dims) {
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks_[axis] = (dims[axis] + kSide - 1) / kSide;
    count *= static_cast<std::size_t>(blocks_[axis]);
  }
  component_.assign(count, kNone);
  for (const EdgeCrossing& crossing : topology.crossings) add(sample_of(crossing, dims), crossing.component);
}

void ComponentBlocks::add(const CellIndex& sample, std::uint32_t component) {
  CellIndex first, last, at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::max(sample[axis] - 1, 0) / kSide;
    last[axis] = std::min((sample[axis] + 1) / kSide, blocks_[axis] - 1);
  }
  for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1]) {
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        std::uint32_t& known = component_[place(at)];
        if (known != component) known = known == kNone ? component : kSeveral;
      }
    }
  }
}

std::optional<std::uint32_t> ComponentBlocks::only_component(const Vec3& point) const {
  CellIndex block;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = std::clamp(point[axis], 0.0, static_cast<double>(dims_[axis] - 1));
    block[axis] = static_cast<std::int32_t>(x) / kSide;
  }
  const std::uint32_t component = component_[place(block)];
  if (component == kNone || component == kSeveral) return std::nullopt;
  return component;
}

}  // namespace deliso
