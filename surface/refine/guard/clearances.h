// Clearances of vertices: bounds of the distance to other sheets of the surface. They tell where triangles of stage 2
// may come to cross (crossing_guard.h).
#pragma once

#include <span>

#include "delaunay/base/vec3.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// Sets the clearance of every vertex.
void set_clearances(RefinementMesh& mesh);
// Sets clearances to 0 near points where triangles came to meet, so that the guard tests all stars there.
void clear_clearances_near(RefinementMesh& mesh, std::span<const Vec3> suspects);
// Sets all clearances to 0: then every star is tested against all triangles around it, so no triangles come to cross.
void clear_all_clearances(RefinementMesh& mesh);

}  // namespace deliso
