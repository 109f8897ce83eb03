// The caller's samples as a grid, copied only where they have to be.
#pragma once

#include "surface/library/deliso/deliso.h"
#include "volume/affine.h"
#include "volume/region.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A grid whose x axis is the axis along which samples follow each other in memory, then y, then z. Axes that run
// backwards are turned. What is parallel to the world's axes keeps the world's coordinates but for their order and
// signs; so a map that only does that rounds nothing.
struct PlacedGrid {
  ScalarGrid grid;
  Affine to_world;  // from the grid's own coordinates
  bool is_copied = false;

  // Whether to_world rounds no coordinate.
  [[nodiscard]] bool is_exact() const;
};

// The samples of the region. Throws InputError, in terms of the caller's axes, when they make no grid: see ScalarGrid
// and frame_of. Samples that are not copied have to outlive it.
PlacedGrid placed_grid(const VolumeView& volume, const SampleRegion& region);

// The samples of the region as they are, with NaN and infinities, in the order of the grid that placed_grid would make,
// and its dimensions.
struct PlainSamples {
  Samples samples;
  Dims dims{};
};
PlainSamples samples_of(const VolumeView& volume, const SampleRegion& region);

}  // namespace deliso
