// What the generators of stress_kinds.h are made of.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {

// Each side in [least, most].
inline Dims small_dims(Rng& rng, std::int32_t least, std::int32_t most) {
  Dims dims{};
  for (std::int32_t& side : dims) side = least + static_cast<std::int32_t>(rng.below(std::uint64_t(most - least + 1)));
  return dims;
}

// A number of either sign, of magnitude 10^least to 10^most.
inline double random_magnitude(Rng& rng, double least, double most) {
  const double sign = rng.below(2) == 0 ? 1 : -1;
  return sign * std::pow(10, rng.uniform(least, most));
}

// Samples from a function of (i, j, k), in the order of the samples.
template <class Sample, class Function>
ScalarGrid grid_of(const Dims& dims, const Vec3& spacing, Function&& f) {
  std::vector<Sample> samples;
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        samples.push_back(static_cast<Sample>(f(Vec3{double(i), double(j), double(k)})));
      }
    }
  }
  return {dims, Samples(std::move(samples)), spacing};
}
template <class Function>
ScalarGrid float_grid(const Dims& dims, const Vec3& spacing, Function&& f) {
  return grid_of<float>(dims, spacing, f);
}
template <class Function>
ScalarGrid double_grid(const Dims& dims, const Vec3& spacing, Function&& f) {
  return grid_of<double>(dims, spacing, f);
}
// Bytes drawn one by one.
template <class Function>
ScalarGrid byte_grid(const Dims& dims, const Vec3& spacing, Function&& next) {
  return grid_of<std::uint8_t>(dims, spacing, [&](const Vec3&) { return next(); });
}

// A sum of waves with frequencies in [least, most] per sample; values within [-3, 3].
inline auto random_waves(Rng& rng, double least, double most) {
  std::array<double, 6> r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = rng.uniform(least, most);
  for (std::size_t i = 3; i < 6; ++i) r[i] = rng.uniform(0, 6.3);
  return [r](const Vec3& p) {
    const double x = r[0] * p.x + r[3], y = r[1] * p.y + r[4], z = r[2] * p.z + r[5];
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  };
}

}  // namespace deliso::testing
