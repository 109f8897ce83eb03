// The marching-cubes mesh of the surface: a mesh whose topology is exact.
#pragma once

#include <cstdint>
#include <functional>
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

// The same without the triangles of some cells, before neighbours are found and take_strips_off; vertices that are
// crossings have their numbers.
ExactPolygonization cubes_without(const ExactSurface& exact, const std::function<bool(const CellIndex&)>& is_left_out);

// Where the volume has walls there are strips of triangles in the layer outside them: puts what lies next to a wall
// onto it, takes the strips out, and finds neighbours anew. Elsewhere nothing changes.
void take_strips_off(ExactPolygonization& surface, const Isosurface& isosurface);

}  // namespace deliso
