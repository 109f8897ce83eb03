// The hits of a line in one extended cell.
#pragma once

#include <algorithm>

#include "raycast/cell_walk.h"
#include "raycast/cubic_solver.h"
#include "raycast/search_options.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Sign changes between two parameters of the line, s_in <= s_out; they alternate between falling and rising.
struct CellHits {
  SignChanges changes;
  bool starts_above = false;
  double s_in = 0;
  double s_out = 0;

  [[nodiscard]] bool falling(int i) const { return starts_above == ((i & 1) == 0); }
  // The caller's line parameter of hit i; ascending.
  [[nodiscard]] double t(const IndexLine& line, int i) const {
    const double s = s_in + changes.at[static_cast<std::size_t>(i)] * (s_out - s_in);
    return line.t_origin + std::min(s, s_out);
  }
};

// The hits in a cell that the line crosses; `low` and `high` are the ends of the segment (in index space).
CellHits solve_cell(const ScalarGrid& grid, double isovalue, CubicSolver solver, const IndexLine& line,
                    const CellVisit& visit, const AxisValues& low, const AxisValues& high);

// Whether the isovalue lies between the samples of an extended cell. An outer cell has only the samples of a face, edge
// or corner of the box.
bool cell_holds(const ScalarGrid& grid, const Cell& cell, double isovalue);

}  // namespace deliso
