// The crossings of the isosurface that a mesh has no triangle near.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/mesh_points.h"

namespace deliso {

// Where no triangle is within the points' reach: indices into topology.crossings, ascending. `asked`: the crossings
// that are asked for, ascending; all, where there is none. The same for any number of threads.
std::vector<std::uint32_t> far_crossings(const MeshPoints& mesh_points, const ExactSurface& surface,
                                         std::optional<std::span<const std::uint32_t>> asked = {});

}  // namespace deliso
