// Steps that insert a point of the isosurface which a mesh misses: the star of a new vertex over the rim of a cavity
// around the nearest triangle. A guard decides which of them may be taken (surface/shape/step_guard.h).
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/shape/patch.h"

namespace deliso {

// The steps to try, the likeliest first, for a point nearest to this triangle: over it and its neighbours, then over
// triangles around its nearest corner. A point in a face of `box` comes to be on the boundary where the cavity has an
// edge of it in that face.
std::vector<PatchStep> insertion_steps(const Patch& patch, std::uint32_t triangle, const Vec3& p, const Box3& box);

}  // namespace deliso
