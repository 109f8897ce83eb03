// Neighbours for triangles that do not have them yet.
#pragma once

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Sets the neighbours of all triangles. Two sides with the same end vertices are neighbours; a side alone has none. In
// a manifold these are the true neighbours; where more than two triangles share an edge, each gets one of the others.
void set_side_adjacency(SurfaceMesh& mesh);

}  // namespace deliso
