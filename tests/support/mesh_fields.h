// Small volumes with a known isosurface, and meshes that lie on it.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/isosurface_probe.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso::testing {

// field(x, y, z) at the samples, in world coordinates.
template <class Field>
ScalarGrid sampled(const Dims& dims, Field field, const Vec3& spacing = {1, 1, 1}, const Vec3& origin = {0, 0, 0}) {
  std::vector<double> samples;
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        samples.push_back(field(origin + scaled(spacing, {double(i), double(j), double(k)})));
      }
    }
  }
  return ScalarGrid(dims, std::move(samples), spacing, origin);
}

// Uniform noise that has been averaged along each axis so many times, for a cube of samples.
inline std::vector<double> smoothed_noise(std::int32_t size, std::uint64_t seed, int passes) {
  Rng rng(seed);
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> values(n * n * n);
  for (double& value : values) value = rng.uniform();
  for (int pass = 0; pass < passes; ++pass) {
    for (const std::size_t stride : {std::size_t{1}, n, n * n}) {
      const std::vector<double> old = values;
      for (std::size_t i = 0; i < old.size(); ++i) {
        const std::size_t at = i / stride % n;
        values[i] = (old[at > 0 ? i - stride : i] + 2 * old[i] + old[at + 1 < n ? i + stride : i]) / 4;
      }
    }
  }
  return values;
}

// Falls outward from `center`; the isosurface of 0 is a sphere but for interpolation.
inline auto ball_field(const Vec3& center, double radius) {
  return [=](const Vec3& p) { return radius - distance(p, center); };
}

// Moves every vertex to the isosurface.
inline TriangleMesh on_isosurface(TriangleMesh mesh, const ScalarGrid& grid, double isovalue) {
  const IsosurfaceTopology truth = exact_topology(grid, isovalue);
  IsosurfaceProbe probe(grid, isovalue, truth.crossings);
  for (Vec3& p : mesh.points) p = probe.to_world(probe.foot_point(probe.to_voxels(p)).point);
  return mesh;
}

}  // namespace deliso::testing
