// Neighbours of triangles that do not know them yet.
#pragma once

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Sets the neighbours of all triangles: sides with the same two ends are neighbours, those with no other are none's. In
// a manifold this is what they are; where more than two share an edge each gets one of the others.
void set_side_adjacency(SurfaceMesh& mesh);

}  // namespace deliso
