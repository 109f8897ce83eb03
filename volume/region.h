// A part of a volume: the samples between two along each axis, counted as the volume's file counts them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "volume/scalar_grid.h"

namespace deliso {

// Along x, y, z: the first and the last sample, both included; nothing: that of the volume.
struct SampleRegion {
  std::array<std::optional<std::int32_t>, 3> first, last;

  [[nodiscard]] bool is_all() const;
};

// From "i0:i1,j0:j1,k0:k1"; a number may be left out. Throws InputError that begins with `source`.
SampleRegion parse_region(const std::string& text, const std::string& source);
// The same text again.
std::string region_text(const SampleRegion& region);

// The first sample of each axis, and how many.
struct SamplePart {
  std::array<std::int32_t, 3> low{};
  Dims dims{};
};
// Throws InputError when the region leaves the samples or has fewer than two along an axis.
SamplePart part_of(const Dims& all, const SampleRegion& region);

// These samples, at their own places. Along axes that run backwards in the file (ScalarGrid::backwards) the region
// counts from the grid's last sample. Throws InputError when the region leaves the grid or has fewer than two samples
// along an axis.
ScalarGrid cropped(const ScalarGrid& grid, const SampleRegion& region);
// The same of other samples at the grid's places, which need not be finite.
Samples cropped(const Samples& samples, const ScalarGrid& grid, const SampleRegion& region);

}  // namespace deliso
