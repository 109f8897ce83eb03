// The exact topology of single voxel cells, found by the program's sweep (volume/topology/cell_sweep.h), for the page.
#pragma once

#include "experiments/config/json.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A few cells in which much happens, no two alike. Each: `cell`, `values` (corners i + 2j + 4k less the isovalue),
// `events` by height w in (0, 1): {w, kind: appear, vanish, move, saddle; u, v}; `below`: of the surface within the
// cell below a height after so many events, its pieces and its Euler characteristic, both counted by a sweep of that
// part alone; `arcs`: of the slice there; `pieces`: the Euler characteristic of each piece of the whole cell.
// Precondition: no sample equals `isovalue`.
Json lesson_cells(const ScalarGrid& grid, double isovalue);

}  // namespace deliso
