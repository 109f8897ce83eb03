// Parts of the surface that a repaired mesh misses near its inverted umbrellas.
//
// If repair connects two sheets at a wrong place, one tunnel replaces another. Then the topology may be right although
// one sheet reaches far through a wall. The vertices of such an inverted umbrella have to stay (inverted_umbrellas.h),
// and no refinement corrects it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/lattice/cell_levels.h"

namespace deliso {

// The grid-edge crossings in some boxes of mesh space that a mesh does not cover (see coverage_query.h), as indices
// into topology.crossings, ascending.
std::vector<std::uint32_t> missed_crossings(const SurfaceMesh& mesh, std::span<const Box3> boxes,
                                            const ExactSurface& surface);

// The active cells within three layers of the cell of some crossing; a cell may be listed several times.
std::vector<CellName> cells_around(std::span<const std::uint32_t> crossings, const ExactSurface& surface,
                                   const CellLevels& cells);

}  // namespace deliso
