// Whether the isosurface passes near a point, by the sides of points around it. In mesh space.
//
// A point is within D of the isosurface when a point at distance D lies on another side of it. That costs two values of
// the field.
#pragma once

#include <optional>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// Whether a point at this distance from p, along a direction or against it, lies on the other side of the isosurface.
// `is_above`: p's side; `falling`: the direction in which the field is likely to fall, of any length.
bool changes_side(const Isosurface& isosurface, const Vec3& p, bool is_above, const Vec3& falling, double distance);

// A point within `reach` of p on the other side, if one is found: points on either side of p tell, first those along
// `falling`, and in the end all around (see other_side.h).
std::optional<Vec3> point_across(const Isosurface& isosurface, const Vec3& p, const Vec3& falling, double reach,
                                 int halvings = 10);

// Whether a point is shown to be so near the isosurface.
bool is_shown_within(const Isosurface& isosurface, const Vec3& p, double distance);

}  // namespace deliso
