// When repair gives a component up: the lattice samples of its refined cells would be many more than its crossings.
//
// Where a few cells are wrong, a lattice there costs little and brings the topology about. In masks and noise nearly
// all cells of a component are, each round refines all of them, and its samples grow fourfold from level to level.
// Marching cubes has the exact topology with a vertex for each crossing; a mesh of many more samples costs more, and
// RefineGeom makes more and worse triangles of it. (In flat cells both have several times as many, by the same pieces:
// cell_pieces.h.) Without this, masks of 32^3 samples go all rounds, each of which costs more than the one before, and
// end in marching cubes all the same. Where an error is stated nothing is given up: samples are needed there, and a
// random mask of 10^3 at 0.05 voxels takes 20 times as long from marching cubes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/lattice/cell_levels.h"

namespace deliso {

// The exact components, of those not done, for which one level more in these cells would take too many samples,
// ascending. `cells` may repeat names. The samples of a cell are estimated by its level.
std::vector<std::uint32_t> components_over_budget(const ExactSurface& surface, const CellLevels& cell_levels,
                                                  std::vector<CellName> cells, const std::vector<bool>& done);

}  // namespace deliso
