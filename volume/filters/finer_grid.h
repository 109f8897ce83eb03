// The same interpolant on a finer grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "volume/region.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A part of a grid, sampled `times` as finely along each axis; its own spacings are 1, its first sample is at 0. The
// interpolant within a part of a voxel cell is trilinear again: so the finer grid has the same one, but for rounding.
// Samples that both grids have are equal. Nothing where it would have more than `most` samples.
std::optional<ScalarGrid> finer_grid(const ScalarGrid& grid, const SamplePart& part,
                                     const std::array<std::int32_t, 3>& times, std::int64_t most);

}  // namespace deliso
