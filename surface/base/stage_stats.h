// What the stages report of their work.
#pragma once

#include <cstdint>

#include "delaunay/base/stopwatch.h"

namespace deliso {

struct StageStats {
  double seconds = 0;
};

// Runs one stage, or a part of it, and adds its wall-clock time to `stage`. Returns what body() returns.
template <class Body>
auto timed(StageStats& stage, Body body) {
  const Stopwatch watch;
  struct AddAtEnd {
    StageStats& stage;
    const Stopwatch& watch;
    ~AddAtEnd() { stage.seconds += watch.seconds(); }
  } const add_at_end{stage, watch};
  return body();
}

struct RepairStats : StageStats {
  std::int64_t rounds = 0;             // rounds of resampling
  std::int64_t cells_refined = 0;      // voxel cells that are sampled by a lattice
  std::int64_t components_before = 0;  // exact components that disagreed with the mesh of stage 1
  // Accepted at the end although their piece has vertices of another component.
  std::int64_t components_mixed = 0;
  std::int64_t components_displaced = 0;        // likewise, with a handle elsewhere (component_match.h)
  std::int64_t components_stray = 0;            // right after stray pieces were dropped
  std::int64_t components_given_up = 0;         // because rounds do not pay in noise (sample_budget.h)
  std::int64_t components_polygonized = 0;      // taken from marching cubes at the end
  std::int64_t foreign_vertices_removed = 0;    // vertices removed from such components (foreign_vertices.h)
  std::int64_t inverted_umbrellas_removed = 0;  // vertices removed from the mesh at the end (inverted_umbrellas.h)
  std::int64_t vertices_before = 0;             // of the mesh of stage 1
  std::int64_t vertices_after = 0;
};

}  // namespace deliso
