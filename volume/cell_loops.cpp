#include "volume/cell_loops.h"

namespace deliso {

namespace {

// Bit f is set for the two faces that contain the edge.
unsigned faces_of_edge(int edge) {
  const CellEdge e = cell_edge(edge);
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != e.axis) faces |= 1u << (2 * axis + (e.corner >> axis & 1));
  }
  return faces;
}

}  // namespace

std::size_t split_into_loops(const EdgeSuccessors& next, std::array<CellLoop, kMaxCellPieces>& loops) {
  std::size_t count = 0;
  std::array<bool, kCellEdges> seen{};
  for (int start = 0; start < kCellEdges; ++start) {
    if (next[static_cast<std::size_t>(start)] < 0 || seen[static_cast<std::size_t>(start)]) continue;
    CellLoop& loop = loops[count++];
    int edge = start;
    do {
      seen[static_cast<std::size_t>(edge)] = true;
      loop.edges[loop.size++] = edge;
      edge = next[static_cast<std::size_t>(edge)];
    } while (edge != start);
  }
  return count;
}

const CellLoop& simple_loop(std::uint8_t pattern) {
  static const std::array<CellLoop, 256> kLoops = [] {
    std::array<CellLoop, 256> table;
    for (unsigned p = 0; p < 256; ++p) {
      std::array<CellLoop, kMaxCellPieces> loops;
      split_into_loops(edge_successors(static_cast<std::uint8_t>(p), 0), loops);
      table[p] = loops[0];
    }
    return table;
  }();
  return kLoops[pattern];
}

bool have_common_face(int edge_a, int edge_b) { return (faces_of_edge(edge_a) & faces_of_edge(edge_b)) != 0; }

}  // namespace deliso
