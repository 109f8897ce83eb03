// The volumes and queries that the tests of the ray caster share.
#pragma once

#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "tests/support/raycast_fields.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {

struct Case {
  ScalarGrid grid;
  double isovalue;
};

// Noise and waves, thin and cubic, isotropic and not.
inline std::vector<Case> cases() {
  Rng rng(7);
  std::vector<Case> list;
  list.push_back({noise_grid({9, 8, 7}, {1, 1, 1}, rng), 127.5});
  list.push_back({noise_grid({2, 2, 2}, {1, 1, 1}, rng), 100.3});
  list.push_back({noise_grid({2, 17, 5}, {0.7, 1.3, 0.9}, rng), 200.1});
  list.push_back({wave_grid({24, 20, 33}, {1, 1, 1}, rng), 0.1});
  list.push_back({wave_grid({31, 12, 16}, {1, 2, 3.5}, rng), -0.7});
  return list;
}

inline std::vector<Hit> hits_of(const Isosurface& surface, const Line& line, double t0, double t1) {
  std::vector<Hit> hits;
  SearchCounters counters;
  surface.all_hits(line, t0, t1, hits, counters);
  return hits;
}

}  // namespace deliso::testing
