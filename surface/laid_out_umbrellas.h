// Vertices around which nothing can meet: their triangles, seen along a coordinate axis, lie side by side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Of each vertex, whether its triangles close up to one fan, each next to the one before it at an edge, that goes
// around the vertex once in the projection along some coordinate axis, every triangle in the same sense. Then of two of
// them the projections have only the projection of what they share in common, and so have the triangles themselves.
// Certain where it is 1 (orientations in the projection are decided with their rounding errors); 0 says nothing.
// Precondition: indices in range; coordinates as orient3d wants them (delaunay/predicates.h).
std::vector<std::uint8_t> laid_out_umbrellas(std::span<const Vec3> points,
                                             std::span<const std::array<std::uint32_t, 3>> triangles, int threads = 1);

}  // namespace deliso
