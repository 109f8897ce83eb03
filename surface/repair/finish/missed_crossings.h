// Parts of the surface that a repaired mesh has lost at its dents.
//
// Where repair joins two sheets at the wrong place, a tunnel for a tunnel, the topology may be right and yet one sheet
// drawn far through a wall. Its vertices have to stay (inverted_umbrellas.h), and no refinement brings it back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/lattice/cell_levels.h"

namespace deliso {

// The grid-edge crossings (places in topology.crossings) in some boxes of mesh space that a mesh does not cover (see
// coverage_query.h), ascending.
std::vector<std::uint32_t> missed_crossings(const SurfaceMesh& mesh, std::span<const Box3> boxes,
                                            const ExactSurface& surface);

// The active cells within three layers of one that holds a crossing, for some crossings; may repeat cells.
std::vector<CellName> cells_around(std::span<const std::uint32_t> crossings, const ExactSurface& surface,
                                   const CellLevels& cells);

}  // namespace deliso
