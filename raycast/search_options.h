// How rays are searched: the keys under "search" of the parameters.
#pragma once

#include <cstdint>

namespace deliso {

enum class CubicSolver { kSchwarze, kBracketed };

// How to find the voxel cells of a segment that can hold the isovalue. All ways find the same cells and the same hits.
enum class Traversal {
  kKdTree,    // the paper's: front to back through a kd-tree with the smallest and largest sample of every node
  kCellWalk,  // cell by cell, with one bit per cell computed for the isovalue; faster on short segments
};

struct SearchOptions {
  CubicSolver solver = CubicSolver::kBracketed;  // Schwarze is the paper's
  bool min_max_pruning = true;                   // drop kd-tree nodes that cannot hold the isovalue
  std::int32_t leaf_cells = 1;                   // voxel cells in a kd-tree leaf, at most; >= 1
  // Find the nearest hit on growing segments, instead of on the whole line at once.
  bool incremental = true;
  Traversal traversal = Traversal::kCellWalk;
};

}  // namespace deliso
