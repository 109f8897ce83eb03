// Bands of triangles between two closed polygons that run alongside each other, and the cheapest of them: a band is a
// path in the lattice of pairs of corners (Fuchs, Kedem and Uselton: Optimal surface reconstruction from planar
// contours, 1977), found by dynamic programming.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "volume/topology/cell_sweep.h"

namespace deliso {

// Once around from the chord between corner 0 of the first polygon and corner `start` of the second one. Each triangle
// takes the next corner of the first polygon, or of the second one when its bit of `along_second` is set; triangle 0
// takes one of the first.
struct LoopBand {
  std::size_t start = 0;
  unsigned along_second = 0;
  double cost = 0;
};

// For every start from which there is a band the one whose chords cost least in total, the cheapest band first.
// `chord_cost(i, j)` of corner i of the first and j of the second polygon may be infinite: then the chord is forbidden.
// No band uses a chord twice. Precondition: sizes of 3 to kCellEdges.
std::vector<LoopBand> loop_bands(std::size_t first_size, std::size_t second_size,
                                 const std::function<double(std::size_t, std::size_t)>& chord_cost);

}  // namespace deliso
