// The options of decimation, and its counters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/base/stage_stats.h"

namespace deliso {

// Lengths in mesh-space units.
struct DecimationOptions {
  double max_error = 1;    // mesh and isosurface stay within this of each other, wherever they were
  std::size_t enough = 0;  // at so many vertices it ends
  double min_angle = 0;    // radians: no triangle gets a smaller angle, unless one that it replaces had a smaller one
  double max_edge = std::numeric_limits<double>::infinity();  // no new edge is longer
  std::vector<Vec3> witnesses;  // points of the isosurface that the mesh has to stay near, beside those it finds itself
};

struct DecimationStats : StageStats {
  std::int64_t vertices_before = 0;
  std::int64_t vertices_after = 0;
  double largest_error = 0;  // of what was done: measured as max_error is
  SearchCounters search;
};

}  // namespace deliso
