// Bands of triangles between two closed polygons, and the cheapest of them. A band is a path in the lattice of pairs of
// corners (Fuchs, Kedem and Uselton: Optimal surface reconstruction from planar contours, 1977); dynamic programming
// finds the cheapest.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "volume/topology/cell_sweep.h"

namespace deliso {

// A closed band that begins at the chord between corner 0 of the first polygon and corner `start` of the second. Each
// triangle advances to the next corner of the first polygon, or of the second one when its bit of `along_second` is
// set. Triangle 0 advances along the first.
struct LoopBand {
  std::size_t start = 0;
  unsigned along_second = 0;
  double cost = 0;
};

// For every start that has a band, the band whose chords cost least in total; the cheapest band comes first.
// `chord_cost(i, j)` is the cost of the chord from corner i of the first to corner j of the second polygon; an infinite
// cost forbids the chord. No band uses a chord twice. Precondition: sizes of 3 to kCellEdges.
std::vector<LoopBand> loop_bands(std::size_t first_size, std::size_t second_size,
                                 const std::function<double(std::size_t, std::size_t)>& chord_cost);

}  // namespace deliso
