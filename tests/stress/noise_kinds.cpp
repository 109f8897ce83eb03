// Kinds of fields in which every cell may hold a surface of its own.
#include <cmath>

#include "tests/stress/stress_fields.h"
#include "tests/stress/stress_kinds.h"

namespace deliso::testing {

// Sums of waves with a little noise: what most volumes are like.
StressCase ordinary_waves(Rng& rng) {
  const Dims dims = small_dims(rng, 6, 10);
  const auto wave = random_waves(rng, 0.3, 0.9);
  const double noise = rng.uniform(0, 0.1);
  return {float_grid(dims, {1, 1, 1}, [&](const Vec3& p) { return wave(p) + noise * rng.uniform(-1, 1); }),
          rng.uniform(-0.3, 0.3)};
}

StressCase white_noise(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 7);
  ScalarGrid grid = byte_grid(dims, {1, 1, 1}, [&] { return rng.below(256); });
  return {std::move(grid), 100.5 + static_cast<double>(rng.below(56)), rng.below(3) == 0};
}

StressCase masks(Rng& rng) {
  const double share = rng.uniform(0.1, 0.9);
  ScalarGrid grid = byte_grid(small_dims(rng, 4, 7), {1, 1, 1}, [&] { return rng.uniform() < share ? 1u : 0u; });
  return {std::move(grid), 0.5, rng.below(2) == 0};
}

// Few values, and an isovalue between them.
StressCase few_values(Rng& rng) {
  const std::uint64_t most = 2 + rng.below(5);
  ScalarGrid grid = byte_grid(small_dims(rng, 4, 7), {1, 1, 1}, [&] { return rng.below(most + 1); });
  return {std::move(grid), rng.uniform(0.02, static_cast<double>(most) - 0.02), rng.below(2) == 0};
}

// Few values, and an isovalue that samples have.
StressCase integers_at_samples(Rng& rng) {
  const std::uint64_t most = 2 + rng.below(5);
  ScalarGrid grid = byte_grid(small_dims(rng, 4, 7), {1, 1, 1}, [&] { return rng.below(most + 1); });
  return {std::move(grid), 1 + static_cast<double>(rng.below(most)), rng.below(2) == 0};
}

// Few values, and an isovalue a little below samples: walls, wires and grains as thin.
StressCase integers_below_samples(Rng& rng) {
  StressCase at = integers_at_samples(rng);
  at.isovalue -= rng.below(2) == 0 ? 0.01 : 0.001;
  return at;
}

// An isovalue that samples have, with one spacing a tenth to a half of the others.
StressCase integers_flat(Rng& rng) {
  const std::uint64_t most = 2 + rng.below(5);
  Vec3 spacing{1, 1, 1};
  spacing[rng.below(3)] = rng.below(2) == 0 ? 0.2 : rng.uniform(0.1, 0.5);
  ScalarGrid grid = byte_grid(small_dims(rng, 3, 7), spacing, [&] { return rng.below(most + 1); });
  return {std::move(grid), 1 + static_cast<double>(rng.below(most - 1)), rng.below(2) == 0};
}

// The isovalue is the largest or the smallest sample.
StressCase integers_at_an_end(Rng& rng) {
  const std::uint64_t most = 2 + rng.below(5);
  ScalarGrid grid = byte_grid(small_dims(rng, 4, 7), {1, 1, 1}, [&] { return rng.below(most + 1); });
  const bool is_top = rng.below(4) != 0;
  return {std::move(grid), is_top ? static_cast<double>(most) : 0, rng.below(4) != 0};
}

// Positive samples over twelve decades.
StressCase magnitudes(Rng& rng) {
  const Vec3 spacing{1, 1, rng.below(3) == 0 ? 0.2 : 1};
  ScalarGrid grid =
      float_grid(small_dims(rng, 4, 7), spacing, [&](const Vec3&) { return std::pow(10, rng.uniform(-6, 6)); });
  return {std::move(grid), std::pow(10, rng.uniform(-2, 2)), rng.below(3) == 0};
}

StressCase signed_magnitudes(Rng& rng) {
  ScalarGrid grid =
      float_grid(small_dims(rng, 4, 7), {1, 1, 1}, [&](const Vec3&) { return random_magnitude(rng, -6, 6); });
  return {std::move(grid), 0};
}

// A smooth field in which a box, or some samples, hold a huge value.
StressCase fill_values(Rng& rng) {
  const Dims dims = small_dims(rng, 6, 9);
  const double fill = random_magnitude(rng, 6, 20);
  const auto wave = random_waves(rng, 0.3, 0.9);
  const bool is_box = rng.below(2) == 0;
  const Vec3 low{double(rng.below(4)), double(rng.below(4)), double(rng.below(4))};
  const double share = rng.uniform(0.01, 0.1);
  const auto is_filled = [&](const Vec3& p) {
    if (!is_box) return rng.uniform() < share;
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x < low.x + 3 && p.y < low.y + 3 && p.z < low.z + 3;
  };
  return {float_grid(dims, {1, 1, 1}, [&](const Vec3& p) { return is_filled(p) ? fill : wave(p); }),
          rng.uniform(-0.3, 0.3)};
}

}  // namespace deliso::testing
