// Marching cubes that are finer in some cells: meshes with the exact topology that are near to the isosurface where it
// bends within a cell, or two of its sheets lie side by side.
#pragma once

#include <optional>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/certificate/finer_cubes.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

// The marching-cubes mesh of the surface (exact_polygonization), in which these cells are divided by the factors along
// each axis. In each of them the interpolant is trilinear, and so it is in its parts: marching cubes of the parts has
// the same topology in the cell, and meets the cell's faces in chains of edges between the crossings of its own edges.
// Cells are divided by themselves: two that share a face make the same chain there, and a triangle of a cell that is
// not divided becomes a fan over the chain in place of its edge. The mesh may cross itself where such a chain bends far
// into a cell: then that cell has to be divided, too. Nothing where a sample of a part would equal the isovalue, for
// which other factors may do, or where the rounding of samples gives a cell other crossings than the grid has.
std::optional<ExactPolygonization> graded_cubes(const ExactSurface& surface, const std::vector<CellIndex>& cells,
                                                const GridFactors& factors);

}  // namespace deliso
