// Whether the isosurface passes near a point, decided by a complete search of the ball around it.
#pragma once

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// Whether some point within `reach` of p lies on the other side of the isosurface than p; however thin the part is that
// it lies in. Points within 2^-10 of the ball's boundary may be missed, but none beyond it is found. In mesh space.
[[nodiscard]] bool has_other_side_within(const Isosurface& isosurface, const Vec3& p, double reach);

}  // namespace deliso
