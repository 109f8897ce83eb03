// Hits of lines in the cells where their searches begin, without a walk from cell to cell: several lines side by side.
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
  Lanes reach{};                            // largest distance of a hit; negative where a line starts beyond the box
  Lanes hit{};                              // the line parameter of the hit; NaN where none is found
};

// The position of index space in mesh space.
struct GridFrame {
  Dims dims{};
  Vec3 inverse_step;
  Vec3 high;  // of the box, in mesh space
};

// Both work on all lanes, or on the first one alone, with the same results.

// Sets line, first and reach. Where an origin lies beyond the box, the cell is that of the nearest point of the box.
void find_start_cells(const LineLanes& lines, double reach, const GridFrame& frame, bool first_alone,
                      StartCells& cells);

// Sets hit from the others: the falling hit nearest to t = 0. No hit is set when it may lie in another cell, or when
// the interpolant cannot be shown to fall all the way from -|t| to |t|: then there may be other hits.
void falling_hits_around(bool first_alone, StartCells& cells);

}  // namespace deliso
