// The pole heights of components from marching cubes. Marching cubes gives one voxel to all, which is what noise needs.
// Where such a component is smooth, RefineGeom made four times as many triangles of it as of others (BABY 16.4: two
// million vertices instead of one).
#pragma once

#include <cstddef>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Raises the heights of the vertices from `first` on to those of a Delaunay triangulation of these vertices, where that
// is more.
void raise_pole_heights(SurfaceMesh& mesh, std::size_t first, const ExactSurface& surface);

}  // namespace deliso
