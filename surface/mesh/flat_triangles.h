// Triangles without area whose middle corner lies on the edge across from it: a vertex on the edge of a neighbour.
//
// Cubes of a volume that is closed along its box have strips in the layer outside it (volume/filters/closing.h), which
// vanish when the mesh is written. Where cubes are finer, the two sides of such a strip have different vertices along
// an edge of the box, and triangles in one line are left. Flipped, the edge ends at the vertex on it. As a set of
// points the mesh stays what it was.
#pragma once

#include <cstdint>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Flips such edges where the mesh stays a manifold without boundary there. Returns how many; sets neighbours if there
// are any.
std::int64_t flip_flat_triangles(SurfaceMesh& mesh);

}  // namespace deliso
