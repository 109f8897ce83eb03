// Where the isosurface meets the box: curves on the six faces (Dey and Levine, section 5).
#pragma once

#include <vector>

#include "raycast/isosurface.h"

namespace deliso {

// Points exactly on the boundary curves, in mesh space: marching squares on the faces of the box. The interpolant is
// bilinear there, and its level set consists of hyperbola arcs. The points are the ends of the arcs (crossings of grid
// edges) and, in face cells with two arcs, a point inside each arc, on the branches given by the asymptotic decider
// (Nielson and Hamann 1991). In order of faces and cells; each crossing once.
std::vector<Vec3> boundary_curve_points(const Isosurface& isosurface);

}  // namespace deliso
