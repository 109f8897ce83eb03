// Inverted umbrellas: vertices at which the mesh of one sheet reaches through a wall to the other sheet.
//
// Repair may sample one sheet of a wall finely and leave the other one coarse. If the wall is thinner than the
// triangles of the coarse sheet are wide, the circumcenters of the tetrahedra between the sheets lie beyond the wall.
// With the signs there, the coarse sheet is connected to vertices of the fine sheet, which then have two copies. The
// topology is right, but the mesh is off the surface by the thickness of the wall. Stage 2 cannot correct this, because
// it keeps all vertices. The same happens in a thin gap between two sheets that face each other.
#pragma once

#include <cstdint>

#include "raycast/isosurface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Removes inner vertices whose triangles face against the surface on the whole, if other triangles lie near the vertex.
// The link is filled by its triangulation of least area. The vertex stays unless the filling has less area than before
// far from a part of the surface that faces the same way, meets no other triangle, and has no edge that the mesh has
// elsewhere. A disk replaces a disk, so the mesh stays homeomorphic to what it was. The mesh may have pole heights or
// none. Returns how many it removed. The same for any number of threads.
std::int64_t remove_inverted_umbrellas(SurfaceMesh& mesh, const Isosurface& isosurface, int threads = 1);

}  // namespace deliso
