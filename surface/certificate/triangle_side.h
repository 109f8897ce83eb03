// Which side of the isosurface a whole triangle lies on.
#pragma once

#include <array>
#include <optional>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// Whether all of a triangle is above the isovalue, or all of it below. Nothing where it meets both sides, or where the
// bounds cannot tell: cut at the faces between voxel cells, the field on each part is a cubic polynomial, which its
// Bernstein coefficients bound from both sides. In mesh space; what lies beyond the box has the extended field.
std::optional<bool> side_of_triangle(const Isosurface& isosurface, const std::array<Vec3, 3>& corners);

}  // namespace deliso
