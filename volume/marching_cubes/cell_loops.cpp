#include "volume/marching_cubes/cell_loops.h"

namespace deliso {

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

}  // namespace deliso
