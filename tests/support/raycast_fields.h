// Small volumes and random lines for the tests of the ray caster.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {

// Samples of the given type from a function of (i, j, k).
template <class Sample, class Function>
ScalarGrid sampled_grid(Dims dims, Vec3 spacing, Function&& f) {
  std::vector<Sample> samples;
  for (std::int32_t k = 0; k < dims[2]; ++k)
    for (std::int32_t j = 0; j < dims[1]; ++j)
      for (std::int32_t i = 0; i < dims[0]; ++i) samples.push_back(static_cast<Sample>(f(i, j, k)));
  return {dims, Samples(std::move(samples)), spacing};
}

// White noise of 8 bits: every cell its own surface, the hardest everyday input.
inline ScalarGrid noise_grid(Dims dims, Vec3 spacing, Rng& rng) {
  return sampled_grid<std::uint8_t>(dims, spacing, [&](auto...) { return static_cast<std::uint8_t>(rng.below(256)); });
}

// Sums of waves: smooth sheets with much space between them.
inline ScalarGrid wave_grid(Dims dims, Vec3 spacing, Rng& rng) {
  const double a = rng.uniform(0.2, 0.6);
  const double b = rng.uniform(0.2, 0.6);
  const double c = rng.uniform(0.2, 0.6);
  return sampled_grid<float>(dims, spacing, [=](double i, double j, double k) {
    return std::sin(a * i) * std::cos(b * j) + std::sin(b * j) * std::cos(c * k) + std::sin(c * k) * std::cos(a * i);
  });
}

// A line of one of the kinds that break ray casters; `p` is a point of the box (grown a little) on it.
inline Line random_line(const Isosurface& surface, Rng& rng) {
  const Vec3 size = surface.box().size();
  const Vec3& step = surface.step();
  const auto coordinate = [&](double side) { return rng.uniform(-0.2 * side, 1.2 * side); };
  const auto lattice = [&](double side, double spacing) {
    const auto count = static_cast<std::uint64_t>(std::lround(side / spacing));
    return static_cast<double>(rng.below(count + 1)) * spacing;
  };
  const auto unit = [&] { return rng.uniform(-1, 1); };
  const auto whole = [&] { return static_cast<double>(rng.below(3)) - 1; };
  Line line{{coordinate(size.x), coordinate(size.y), coordinate(size.z)}, {unit(), unit(), unit()}};
  const Vec3 lattice_point{lattice(size.x, step.x), lattice(size.y, step.y), lattice(size.z, step.z)};
  switch (rng.below(6)) {
    case 0:  // parallel to an axis, anywhere
      line.direction = {};
      line.direction[rng.below(3)] = rng.below(2) == 0 ? 1 : -1;
      break;
    case 1: {  // in a lattice plane
      const std::size_t axis = rng.below(3);
      line.origin[axis] = lattice_point[axis];
      line.direction[axis] = 0;
      break;
    }
    case 2:  // through a lattice point
      line.origin = lattice_point;
      break;
    case 3:  // along lattice edges and diagonals
      line.origin = lattice_point;
      line.direction = {whole() * step.x, whole() * step.y, whole() * step.z};
      break;
    case 4:  // nearly parallel to an axis
      line.direction = scaled(line.direction, {1e-9, 1, 1e-7});
      break;
    default:
      break;
  }
  return line;
}

inline std::string describe(const Line& line, double t0, double t1) {
  char text[400];
  std::snprintf(text, sizeof text, "origin (%a, %a, %a) direction (%a, %a, %a) t [%a, %a]", line.origin.x,
                line.origin.y, line.origin.z, line.direction.x, line.direction.y, line.direction.z, t0, t1);
  return text;
}

}  // namespace deliso::testing
