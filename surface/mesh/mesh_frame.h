// Meshes between the grid's own coordinates and those of their files.
#pragma once

#include "surface/mesh/triangle_mesh.h"
#include "volume/affine.h"

namespace deliso {

// The mesh under the map. Where it reflects, triangles are turned over, so that they face the same side as before.
TriangleMesh transformed(TriangleMesh mesh, const Affine& map);

}  // namespace deliso
