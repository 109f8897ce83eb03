// Clearances of vertices: bounds of the distance to other sheets of the surface, which tell where triangles of stage 2
// can come to cross (crossing_guard.h).
#pragma once

#include <span>

#include "delaunay/base/vec3.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// Sets the clearance of every vertex.
void set_clearances(RefinementMesh& mesh);
// Takes clearances away near places where triangles came to meet.
void distrust(RefinementMesh& mesh, std::span<const Vec3> suspects);
// Takes all clearances away: then every star is tested against all triangles around it, so that none comes to cross.
void distrust_all(RefinementMesh& mesh);

}  // namespace deliso
