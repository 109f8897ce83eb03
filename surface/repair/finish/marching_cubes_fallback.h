// The end of repair: pieces of the mesh that cross, or lie on the wrong component, are replaced by the marching-cubes
// mesh of their components.
#pragma once

#include <vector>

#include "surface/base/controls.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"

namespace deliso {

// Replaces pieces that cross. Pieces may cross if they come from different Delaunay meshes, or if copies of a vertex
// could not be moved apart. The component of a piece is the one on which most of its vertices lie. Marching cubes does
// not cross itself, so with enough of it nothing crosses. If the crossing pieces cannot be determined, all components
// are taken from marching cubes. `is_polygonized` tells, for each component, whether it comes from marching cubes; it
// is updated. Precondition: the mesh has pole heights. A run that must stop leaves the mesh as it is.
void polygonize_crossing_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache, std::vector<bool>& is_polygonized,
                                Controls& controls);

// The same for pieces with assignment faults (component_assignment.h): pieces that have as many vertices on another
// component as its own piece has, that share a component, or whose topology is wrong. True if there were any.
bool polygonize_misplaced_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache, std::vector<bool>& is_polygonized);

}  // namespace deliso
