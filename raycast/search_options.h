// How rays are searched: the keys under "search" of the parameters.
#pragma once

#include <cstdint>

namespace deliso {

enum class CubicSolver { kSchwarze, kBracketed };

// How the voxel cells of a segment that can hold the isovalue are found. All find the same cells and the same hits.
enum class Traversal {
  kKdTree,    // the paper's: front to back through a kd-tree with the smallest and largest sample of every node
  kCellWalk,  // cell by cell over one bit per cell, made for the isovalue: the faster one on short segments
};

struct SearchOptions {
  CubicSolver solver = CubicSolver::kBracketed;  // Schwarze is the paper's
  bool min_max_pruning = true;                   // drop kd-tree nodes that cannot hold the isovalue
  std::int32_t leaf_cells = 1;                   // voxel cells in a kd-tree leaf, at most; >= 1
  bool incremental = true;                       // nearest hit by growing segments, not over the whole line
  Traversal traversal = Traversal::kCellWalk;
};

}  // namespace deliso
