// Dents: where the mesh of one sheet of the surface reaches through a wall to a vertex of the other sheet.
//
// Repair samples one sheet of a wall finely and leaves the other one coarse. Where the wall is thinner than triangles
// of the coarse sheet are wide, circumcenters of the tetrahedra between lie beyond it, and with their signs the coarse
// sheet is drawn in to vertices of the fine one, which are given twice there. The topology is right, but the mesh is as
// far off the surface as the wall is thick, and stage 2 cannot help: its vertices stay. The same happens outside of a
// wall between two sheets that face each other.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "raycast/isosurface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

struct InvertedUmbrellaRemoval {
  std::int64_t removed = 0;  // vertices
  std::vector<Box3> left;    // around the links of those that had to stay
};

// Takes inner vertices out of the mesh whose triangles face against the surface on the whole, when other triangles lie
// where the vertex is. What is left open is closed by the triangulation of the link that has the least area, if less of
// it than before is far from the surface that faces the same way, and if it meets no other triangle and has no edge
// that the mesh has elsewhere; or else the vertex stays. A disk replaces a disk, so the mesh stays homeomorphic to what
// it was. The mesh may have pole heights or none. The same for any number of threads.
InvertedUmbrellaRemoval remove_inverted_umbrellas(SurfaceMesh& mesh, const Isosurface& isosurface, int threads = 1);

}  // namespace deliso
