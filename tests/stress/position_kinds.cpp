// Kinds of fields that are hard by where the surface lies: at the box, at grid points, in flat cells, cut off.
#include <algorithm>
#include <cmath>

#include "tests/stress/stress_fields.h"
#include "tests/stress/stress_kinds.h"

namespace deliso::testing {

namespace {

bool lies_on_box(const Vec3& p, const Dims& dims) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] == 0 || p[axis] == dims[axis] - 1) return true;
  }
  return false;
}

// A number of this sign and of 1e-15 to 1e-6.
double tiny(Rng& rng) { return random_magnitude(rng, -15, -6); }

// Waves or noise around isovalue 0, of which some samples are tiny.
template <class IsTiny>
ScalarGrid near_grid_points(Rng& rng, const Dims& dims, const IsTiny& is_tiny) {
  const auto wave = random_waves(rng, 0.4, 1);
  const bool is_noise = rng.below(3) == 0;
  return double_grid(dims, {1, 1, 1}, [&](const Vec3& p) {
    if (is_tiny(p)) return tiny(rng);
    return is_noise ? rng.uniform(-1, 1) : wave(p);
  });
}

}  // namespace

// The surface comes within 1e-15 to 1e-6 of faces, edges and corners of the box.
StressCase at_the_box(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 7);
  const double share = rng.uniform(0.05, 0.6);
  return {near_grid_points(rng, dims, [&](const Vec3& p) { return lies_on_box(p, dims) && rng.uniform() < share; }), 0};
}

// The same at grid points anywhere.
StressCase at_grid_points(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 7);
  const double share = rng.uniform(0.02, 0.3);
  return {near_grid_points(rng, dims, [&](const Vec3&) { return rng.uniform() < share; }), 0};
}

// Smooth bumps in 16 bits; some reach through the box.
StressCase cut_bumps(Rng& rng) {
  const Dims dims{9, 7, 5};
  std::vector<std::pair<Vec3, double>> bumps;
  for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
    const Vec3 centre{rng.uniform(-1, 9), rng.uniform(-1, 7), rng.uniform(-1, 5)};
    bumps.emplace_back(centre, rng.uniform(0.5, 2.5));
  }
  const double height = rng.uniform(500, 30000);
  ScalarGrid grid =
      grid_of<std::uint16_t>(dims, {1, 1, rng.below(3) == 0 ? rng.uniform(0.3, 3) : 1}, [&](const Vec3& p) {
        double sum = 0;
        for (const auto& [centre, width] : bumps) sum += std::exp(-squared_distance(p, centre) / (width * width));
        return std::min(65535.0, height * sum);
      });
  const auto [lowest, highest] = grid.range();
  const double isovalue = lowest + rng.uniform(0.02, 0.98) * (highest - lowest) + 0.5;
  return {std::move(grid), std::min(isovalue, highest), rng.below(4) == 0};
}

// Smooth fields with one spacing 12 to 40 times smaller than the others.
StressCase flat_smooth(Rng& rng) {
  const auto wave = random_waves(rng, 0.3, 0.8);
  Vec3 spacing{1, 1, 1};
  spacing[rng.below(3)] = 1 / std::exp(rng.uniform(std::log(12), std::log(40)));
  return {float_grid(small_dims(rng, 4, 6), spacing, wave), rng.uniform(-0.3, 0.3)};
}

StressCase flat_rough(Rng& rng) {
  Vec3 spacing{1, 1, 1};
  spacing[rng.below(3)] = 1 / std::exp(rng.uniform(std::log(12), std::log(40)));
  return {byte_grid(small_dims(rng, 3, 4), spacing, [&] { return rng.below(256); }),
          100.5 + static_cast<double>(rng.below(56))};
}

// No triangle of stage 2 is too small to be refined.
StressCase no_r_min(Rng& rng) {
  StressCase made = rng.below(2) == 0 ? ordinary_waves(rng) : specks(rng);
  made.sets = {{"stage2.r_min", 0}};
  return made;
}

// Smooth balls of radius 80 to 130.
StressCase large_balls(Rng& rng) {
  const double radius = rng.uniform(80, 130);
  const auto side = static_cast<std::int32_t>(2 * radius + 6);
  const Vec3 centre{radius + rng.uniform(2, 3), radius + rng.uniform(2, 3), radius + rng.uniform(2, 3)};
  return {float_grid({side, side, side}, {1, 1, 1}, [&](const Vec3& p) { return radius - distance(p, centre); }), 0};
}

}  // namespace deliso::testing
