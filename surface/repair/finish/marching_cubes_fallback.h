// Components from marching cubes, where no other mesh is right.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/base/controls.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/finish/nearer_cubes.h"

namespace deliso {

// Appends the marching-cubes mesh of some components, in flat cells that of a finer grid as far as there is one
// (finer_cubes.h), else in parts of cells where it has to be nearer; and their numbers for its vertices, if wanted. Its
// pole heights are those of the Delaunay triangulation of its vertices, but one voxel at least, which is what noise
// needs. Where such a component is smooth, one voxel alone makes RefineGeom give it four times as many triangles as
// others have (BABY 16.4: two million vertices instead of one).
void append_cubes(const ExactSurfaceCache& cache, const std::vector<bool>& components,
                  const std::optional<CubeNearness>& nearness, SurfaceMesh& mesh,
                  std::vector<std::uint32_t>* component_of = nullptr);

// Replaces pieces that cross. Pieces may cross if they come from different Delaunay meshes, or if copies of a vertex
// could not be moved apart. The component of a piece is the one on which most of its vertices lie. Marching cubes does
// not cross itself, so with enough of it nothing crosses. If the crossing pieces cannot be determined, all components
// are taken from marching cubes. `is_polygonized` tells, for each component, whether it comes from marching cubes; it
// is updated. Precondition: the mesh has pole heights. A run that must stop leaves the mesh as it is.
void polygonize_crossing_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache,
                                const std::optional<CubeNearness>& nearness, std::vector<bool>& is_polygonized,
                                Controls& controls);

// The same for pieces with assignment faults (component_assignment.h): pieces that have as many vertices on another
// component as its own piece has, that share a component, or whose topology is wrong. True if there were any.
bool polygonize_misplaced_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache,
                                 const std::optional<CubeNearness>& nearness, std::vector<bool>& is_polygonized);

}  // namespace deliso
