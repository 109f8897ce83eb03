// The loops in which the isosurface meets the boundary of a cell: closed polygons of grid-edge crossings.
//
// On a face the mesh draws straight chords for the arcs. Two arcs on one (ambiguous) face cut off opposite corners,
// whichever way the asymptotic decider joins them. Put one of these corners at (0, 0): its chord runs from (a, 0) to
// (0, b) with a, b < 1, so x + y < 1 on it, and x + y > 1 on the other chord. So the loops of a cell are disjoint
// simple polygons, and both cells of a face draw the same chords on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "volume/topology/cell_sweep.h"

namespace deliso {

// A loop of crossings, counterclockwise around the surface's piece seen from the lower side.
struct CellLoop {
  std::size_t size = 0;
  std::array<int, kCellEdges> edges{};
};

// Splits the crossings of a cell into loops; returns their number.
std::size_t split_into_loops(const EdgeSuccessors& next, std::array<CellLoop, kMaxCellPieces>& loops);

// The one loop of a simple sign pattern (is_simple), from a table.
const CellLoop& simple_loop(std::uint8_t pattern);

// For each edge of the cell, one bit for each of the two faces that contain it.
inline constexpr std::array<std::uint8_t, kCellEdges> kFacesOfEdge = [] {
  std::array<std::uint8_t, kCellEdges> faces{};
  for (unsigned edge = 0; edge < kCellEdges; ++edge) {
    const unsigned axis = edge / 4;
    const unsigned first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;  // the other axes
    faces[edge] = static_cast<std::uint8_t>(1u << (2 * first + (edge & 1)) | 1u << (2 * second + (edge >> 1 & 1)));
  }
  return faces;
}();

// Whether some face of the cell contains both edges.
inline bool have_common_face(int edge_a, int edge_b) {
  return (kFacesOfEdge[static_cast<std::size_t>(edge_a)] & kFacesOfEdge[static_cast<std::size_t>(edge_b)]) != 0;
}

}  // namespace deliso
