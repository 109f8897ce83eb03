// The part of a convex hull's boundary that lies between two closed polygons of hull edges, decided exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/marching_cubes/exact_tests.h"

namespace deliso {

// Triangles that cover the part of the hull's boundary between the two polygons. They are oriented so that each polygon
// edge is an edge of one triangle, in the polygon's direction. Empty when no part of the boundary lies on the same side
// of both polygons. Precondition: at most 32 points, every one a corner of the hull; the polygons are disjoint cycles
// of edges of hull facets.
std::vector<std::array<std::uint32_t, 3>> hull_annulus(std::span<const Vec3> points,
                                                       std::span<const std::uint32_t> first,
                                                       std::span<const std::uint32_t> second, const ExactTests& tests);

}  // namespace deliso
