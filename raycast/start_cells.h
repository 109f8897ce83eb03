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
  Lanes reach{};                            // no hit may be farther; negative where a line starts beyond the box
  Lanes hit{};                              // the line parameter of the hit; NaN where none is found
};

// How index space lies in mesh space.
struct GridFrame {
  Dims dims{};
  Vec3 inverse_step;
  Vec3 high;  // of the box, in mesh space
};

// Sets line, first and reach; where an origin lies beyond the box, those of the point nearest to it.
void find_start_cells(const LineLanes& lines, double reach, const GridFrame& frame, StartCells& cells);

// Sets hit from the others: the falling hit nearest to t = 0. Nothing when it may lie in another
// cell, or when the interpolant is not seen to fall all the way from -|t| to |t|: then there may be other hits.
void falling_hits_around(StartCells& cells);

}  // namespace deliso
