// How rays are searched: the keys under "search" of the parameters.
#pragma once

#include <cstdint>

namespace deliso {

enum class CubicSolver { kSchwarze, kBracketed };

struct SearchOptions {
  CubicSolver solver = CubicSolver::kBracketed;  // Schwarze is the paper's
  bool min_max_pruning = true;                   // drop kd-tree nodes that cannot hold the isovalue
  std::int32_t leaf_cells = 1;                   // voxel cells in a kd-tree leaf, at most; >= 1
  bool incremental = true;                       // nearest hit by growing segments, not over the whole line
};

}  // namespace deliso
