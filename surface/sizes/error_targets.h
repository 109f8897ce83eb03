// Where a mesh that is too far from its isosurface is to get vertices.
#pragma once

#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/geometry_check.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The crossings that the mesh misses, and for each triangle that is too far the point of the isosurface ahead of the
// part of it that is farthest, if there is one. `most`: the distance checked. In mesh space.
std::vector<Vec3> error_targets(const SurfaceMesh& mesh, const ExactSurface& surface, const GeometryCheck& check,
                                double most);

// Sets pole heights so that criterion 2 of stage 2 (r / mean pole height > 1) halves the circumradius where the mesh is
// too far: of triangles too far from the isosurface, and of those nearest to the crossings missed. Elsewhere it never
// holds.
void ask_for_smaller_triangles(SurfaceMesh& mesh, const ExactSurface& surface, const GeometryCheck& check);

}  // namespace deliso
