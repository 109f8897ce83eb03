// Whether all of a triangle lies within a distance of the isosurface, by a proof: no points are left out.
//
// The distance from a surface changes no faster than the place, so a part of a triangle within R of its centroid is
// within D of the isosurface when the centroid is within D - R. And where all of a part, moved by D along some
// direction, is on one side of the isosurface, and moved against it on the other, a way of length D leads from each of
// its points to the isosurface. The first settles parts that are not much larger than D, the second all others that the
// isosurface is not too crooked beside. Parts that neither settles are divided (branch and bound).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// How many parts of a triangle are not shown to be within `most` of the isosurface, counted up to `enough`; their
// middles are appended to `places`. None: all of it is. Corners are taken for points of the isosurface. Where the
// distance is more than three quarters of `most`, it may not be shown. In mesh space.
std::int64_t count_far_parts(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double most,
                             std::int64_t enough = std::numeric_limits<std::int64_t>::max(),
                             std::vector<Vec3>* places = nullptr);

}  // namespace deliso
