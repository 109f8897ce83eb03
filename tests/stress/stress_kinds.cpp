#include "tests/stress/stress_kinds.h"

namespace deliso::testing {

const std::vector<StressKind>& stress_kinds() {
  static const std::vector<StressKind> kKinds = {
      {"ordinary", "waves with a little noise", ordinary_waves},
      {"white_noise", "bytes drawn one by one", white_noise},
      {"masks", "0 or 1", masks},
      {"few_values", "small integers, isovalue between them", few_values},
      {"integers", "small integers, isovalue that samples have", integers_at_samples},
      {"integers_below", "small integers, isovalue 0.01 or 0.001 below", integers_below_samples},
      {"integers_flat", "isovalue that samples have, one spacing 0.1 to 0.5", integers_flat},
      {"integers_end", "the same, isovalue the largest or smallest sample", integers_at_an_end},
      {"magnitudes", "10^-6 to 10^6", magnitudes},
      {"signed_magnitudes", "the same with signs, isovalue 0", signed_magnitudes},
      {"fill", "waves beside a fill value of 1e6 to 1e20", fill_values},
      {"straight_tubes", "0.05 to 0.2 voxel wide", straight_tubes},
      {"bent_tubes", "L-shaped, 0.05 to 0.2 voxel wide", bent_tubes},
      {"specks", "balls thinner than a voxel", specks},
      {"shells", "sheets 0.05 to 0.2 voxel thick", shells},
      {"box_needles", "rows of samples on the box, 1e-4 to 0.2 voxel wide", box_needles},
      {"squeezed_necks", "1e-14 to 1e-2 off a saddle", squeezed_necks},
      {"at_the_box", "within 1e-15 to 1e-6 of faces, edges and corners of the box", at_the_box},
      {"at_grid_points", "within 1e-15 to 1e-6 of samples", at_grid_points},
      {"cut_bumps", "smooth 16 bits, 9x7x5, cut by the box", cut_bumps},
      {"flat_smooth", "waves, spacings 1 : 12 to 1 : 40", flat_smooth, 5},
      {"flat_rough", "noise, spacings 1 : 12 to 1 : 40", flat_rough, 5},
      {"no_r_min", "waves and specks, stage2.r_min = 0", no_r_min},
      {"large_balls", "radius 80 to 130", large_balls, 50},
  };
  return kKinds;
}

}  // namespace deliso::testing
