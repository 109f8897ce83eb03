// Whether the isosurface passes near a point, decided by a complete search of the ball around it.
#pragma once

#include <optional>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

// A point within `reach` of p that lies on the other side of the isosurface than p, if there is one; however thin the
// part is that it lies in. Boxes around p are halved so many times: points as near to the ball's boundary as the
// smallest ones are large may be missed, but none beyond it is found. In mesh space.
[[nodiscard]] std::optional<Vec3> other_side_within(const Isosurface& isosurface, const Vec3& p, double reach,
                                                    int halvings = 10);

}  // namespace deliso
