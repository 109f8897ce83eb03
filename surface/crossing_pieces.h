// The end of repair: pieces of its mesh that cross are replaced by what marching cubes makes of their components.
#pragma once

#include <cstdint>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/surface_facts.h"
#include "surface/surface_mesh.h"

namespace deliso {

// Pieces of Delaunay meshes may cross where they come from different ones or where copies of a vertex could not be
// moved apart. Marching cubes does not cross itself, so with enough of it nothing crosses. A piece of the mesh has the
// vertices of one component, but for a few. `is_polygonized`, of each component: it comes from marching cubes; kept up
// to date. Returns how many components became so. The mesh has pole heights.
std::int64_t polygonize_crossing_pieces(SurfaceMesh& mesh, const SurfaceFacts& facts, const Isosurface& isosurface,
                                        std::vector<bool>& is_polygonized, int threads);

}  // namespace deliso
