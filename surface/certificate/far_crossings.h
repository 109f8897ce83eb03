// The crossings of the isosurface that a mesh has no triangle near.
#pragma once

#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/mesh_points.h"

namespace deliso {

// Where no triangle is within the points' reach, in the order of the crossings; in mesh space. The same for any number
// of threads.
std::vector<Vec3> far_crossings(const MeshPoints& mesh_points, const ExactSurface& surface);

}  // namespace deliso
