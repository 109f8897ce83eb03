// Vertices that do not belong together and have one place once coordinates are rounded: beside a sample that is larger
// than its neighbours by sixteen orders of magnitude, two components end at the same point of the box. Their triangles
// would touch.
#pragma once

#include <cstdint>
#include <span>

#include "delaunay/base/box3.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Moves all vertices that have the place of another a little way into their own triangles, in the faces of the box that
// they lie on; less than a fifth of what vertices may be off the isosurface. Returns how many. Precondition: those that
// can be merged have been (equal_vertices.h). `places`: where each vertex is written.
std::int64_t separate_equal_vertices(std::span<const Vec3> places, const Box3& box, SurfaceMesh& mesh);

}  // namespace deliso
