// The kinds of volumes that the mesher is stressed with: seeded generators, each of a way in which a field is hard.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/base/parameters.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {

struct StressCase {
  ScalarGrid grid;
  double isovalue = 0;
  bool is_closed = false;  // boundary = closed
  std::vector<std::pair<std::string_view, double>> sets =
      {};  // further parameters that differ from the defaults, by key
};

struct StressKind {
  std::string_view name;
  std::string_view what;
  StressCase (*make)(Rng& rng);
  std::int64_t share = 1;  // runs take so long that only one in so many is made
};

// All kinds; the first is the ordinary one that the others' times are compared with.
const std::vector<StressKind>& stress_kinds();

// The generators, by the file that they are in. Noise: every cell may hold a surface of its own.
StressCase ordinary_waves(Rng& rng);
StressCase white_noise(Rng& rng);
StressCase masks(Rng& rng);
StressCase few_values(Rng& rng);
StressCase integers_at_samples(Rng& rng);
StressCase integers_below_samples(Rng& rng);
StressCase integers_flat(Rng& rng);
StressCase integers_at_an_end(Rng& rng);
StressCase magnitudes(Rng& rng);
StressCase signed_magnitudes(Rng& rng);
StressCase fill_values(Rng& rng);

// Thin parts: thinner than a voxel.
StressCase straight_tubes(Rng& rng);
StressCase bent_tubes(Rng& rng);
StressCase specks(Rng& rng);
StressCase shells(Rng& rng);
StressCase box_needles(Rng& rng);
StressCase squeezed_necks(Rng& rng);

// Positions: on the box and its corners, flat spacings, cut bumps, plain balls.
StressCase at_the_box(Rng& rng);
StressCase at_grid_points(Rng& rng);
StressCase cut_bumps(Rng& rng);
StressCase flat_smooth(Rng& rng);
StressCase flat_rough(Rng& rng);
StressCase no_r_min(Rng& rng);
StressCase large_balls(Rng& rng);

}  // namespace deliso::testing
