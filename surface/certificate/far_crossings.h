// The crossings of the isosurface that a mesh has no triangle near.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Edges longer than this many reaches may pass a crossing whose surroundings hold none of their ends.
inline constexpr double kLongEdge = 2;

// Where no triangle is within `reach`, in the order of the crossings; in mesh space. `long_triangles`: all triangles
// that have a long edge. The same for any number of threads.
std::vector<Vec3> far_crossings(const SurfaceMesh& mesh, const ExactSurface& surface, double reach,
                                const std::vector<std::uint32_t>& long_triangles);

}  // namespace deliso
