// Hits of lines close to where the searches begin, without walks from cell to cell: several lines side by side.
#pragma once

#include <array>
#include <cstddef>

#include "delaunay/base/lanes.h"
#include "raycast/line.h"

namespace deliso {

// The cells that lines start in.
struct StartCells {
  LineLanes line;                           // in the cells' own parameters
  std::array<std::size_t, kLanes> first{};  // the index of a cell's lowest sample
  std::array<Lanes, 8> relative{};          // the cells' corners less the isovalue
  Lanes hit{};                              // the line parameter of the hit; NaN where none is found
};

// Sets line and first; where an origin lies beyond the box of the samples, that of the point nearest to it.
void find_start_cells(const LineLanes& lines, const Vec3& inverse_step, const Dims& dims, StartCells& cells);

// Sets hit from line and relative: the falling hit nearest to t = 0. Nothing when it may lie in another
// cell, or when the interpolant is not seen to fall all the way from -|t| to |t|: then there may be other hits.
void falling_hits_around(StartCells& cells);

}  // namespace deliso
