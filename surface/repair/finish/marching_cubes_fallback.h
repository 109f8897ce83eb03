// The end of repair: pieces of its mesh that cross, or lie where others belong, are replaced by what marching cubes
// makes of their components.
#pragma once

#include <vector>

#include "surface/base/controls.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"

namespace deliso {

// Pieces of Delaunay meshes may cross where they come from different ones or where copies of a vertex could not be
// moved apart. The component of a piece is the one that most of its vertices lie on. Marching cubes does not cross
// itself, so with enough of it nothing crosses; where it is not told which pieces are to blame, all components are
// polygonized. `is_polygonized`, of each component: it comes from marching cubes; kept up to date. The mesh has pole
// heights. A run that has to stop keeps what there is.
void polygonize_crossing_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& facts, std::vector<bool>& is_polygonized,
                                Controls& controls);

// The same for pieces that are in the wrong place (component_assignment.h): that lie on another component as much as
// its own piece does, share a component, or are of another topology. True when there were any.
bool polygonize_misplaced_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& facts, std::vector<bool>& is_polygonized);

}  // namespace deliso
