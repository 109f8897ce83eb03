// The marching-cubes mesh of the surface: a mesh whose topology is exact.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The marching-cubes mesh in mesh space, with pole heights of one voxel, and the exact component of each vertex. Of a
// closed volume it lies within the walls.
struct ExactPolygonization {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> component;
};
ExactPolygonization exact_polygonization(const ExactSurface& exact);

// Where the volume has walls there are strips of triangles in the layer outside them: puts what lies next to a wall
// onto it, takes the strips out, and finds neighbours anew. Elsewhere nothing changes.
void take_strips_off(ExactPolygonization& surface, const Isosurface& isosurface);

}  // namespace deliso
