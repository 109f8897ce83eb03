// Grids for the topology tests: sampled fields, random integers, refinements with the same interpolant, the symmetries
// of the cube.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/base/vec3.h"
#include "tests/support/topology_oracle.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso::test {

// field(x, y, z) at the samples, which are unit steps apart.
inline ScalarGrid sampled(const Dims& dims, const std::function<double(const Vec3&)>& field) {
  std::vector<double> samples;
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        samples.push_back(field({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
      }
    }
  }
  return {dims, samples};
}

// Samples uniform in {-range, ..., range - 1} and the isovalue -1/2: both signs are equally likely, and for a small
// range ties are everywhere.
inline IntegerGrid random_integer_grid(Rng& rng, const Dims& dims, std::int64_t range) {
  IntegerGrid grid{dims, {}, -1};
  const auto count =
      static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(dims[2]);
  for (std::size_t i = 0; i < count; ++i) {
    grid.samples.push_back(static_cast<std::int64_t>(rng.below(static_cast<std::uint64_t>(2 * range))) - range);
  }
  return grid;
}

inline Dims random_dims(Rng& rng, std::int32_t largest) {
  Dims dims{};
  for (std::int32_t& d : dims) d = 2 + static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(largest - 1)));
  return dims;
}

inline ScalarGrid scalar_grid(const IntegerGrid& grid) {
  return {grid.dims, std::vector<double>(grid.samples.begin(), grid.samples.end())};
}
inline double isovalue_of(const IntegerGrid& grid) { return static_cast<double>(grid.twice_isovalue) / 2; }

inline bool is_singular(const IntegerGrid& grid) {
  return !exact_topology(scalar_grid(grid), isovalue_of(grid)).singular_cells.empty();
}

// n samples for every voxel step, all values times n^3: the same interpolant, exactly.
inline IntegerGrid refined(const IntegerGrid& grid, std::int32_t n) {
  IntegerGrid fine{{}, {}, grid.twice_isovalue * n * n * n};
  for (std::size_t a = 0; a < 3; ++a) fine.dims[a] = (grid.dims[a] - 1) * n + 1;
  std::array<std::int32_t, 3> p{};
  for (p[2] = 0; p[2] < fine.dims[2]; ++p[2]) {
    for (p[1] = 0; p[1] < fine.dims[1]; ++p[1]) {
      for (p[0] = 0; p[0] < fine.dims[0]; ++p[0]) {
        std::int64_t value = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
          std::int64_t weight = 1;
          std::int64_t sample = 0;
          for (std::size_t a = 3; a-- > 0;) {
            const std::int32_t cell = std::min(p[a] / n, grid.dims[a] - 2);
            const std::int32_t offset = p[a] - cell * n;
            const auto bit = static_cast<std::int32_t>(corner >> a & 1u);
            weight *= bit == 1 ? offset : n - offset;
            sample = sample * grid.dims[a] + cell + bit;
          }
          value += weight * grid.samples[static_cast<std::size_t>(sample)];
        }
        fine.samples.push_back(value);
      }
    }
  }
  return fine;
}

// One of the 48 symmetries of the cube: output axis a is input axis `axes[a]`, reversed when `reversed[a]`.
struct CubeSymmetry {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::array<bool, 3> reversed{};
};

inline std::vector<CubeSymmetry> cube_symmetries() {
  std::vector<CubeSymmetry> all;
  CubeSymmetry symmetry;
  do {
    for (unsigned bits = 0; bits < 8; ++bits) {
      for (unsigned a = 0; a < 3; ++a) symmetry.reversed[a] = (bits >> a & 1u) != 0;
      all.push_back(symmetry);
    }
  } while (std::next_permutation(symmetry.axes.begin(), symmetry.axes.end()));
  return all;
}

// The corner of the cell that comes to corner c of the transformed cell.
inline int source_corner(const CubeSymmetry& symmetry, int c) {
  int source = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const int bit = (c >> a & 1) ^ (symmetry.reversed[a] ? 1 : 0);
    source |= bit << symmetry.axes[a];
  }
  return source;
}

inline IntegerGrid transformed(const IntegerGrid& grid, const CubeSymmetry& symmetry) {
  IntegerGrid result{{}, {}, grid.twice_isovalue};
  for (std::size_t a = 0; a < 3; ++a) result.dims[a] = grid.dims[symmetry.axes[a]];
  std::array<std::int32_t, 3> p{};
  for (p[2] = 0; p[2] < result.dims[2]; ++p[2]) {
    for (p[1] = 0; p[1] < result.dims[1]; ++p[1]) {
      for (p[0] = 0; p[0] < result.dims[0]; ++p[0]) {
        std::array<std::int32_t, 3> q{};
        for (std::size_t a = 0; a < 3; ++a)
          q[symmetry.axes[a]] = symmetry.reversed[a] ? result.dims[a] - 1 - p[a] : p[a];
        const std::int64_t index = q[0] + static_cast<std::int64_t>(grid.dims[0]) * (q[1] + grid.dims[1] * q[2]);
        result.samples.push_back(grid.samples[static_cast<std::size_t>(index)]);
      }
    }
  }
  return result;
}

inline std::vector<ComponentTopology> sorted_components(const IsosurfaceTopology& topology) {
  std::vector<ComponentTopology> components = topology.components;
  std::sort(components.begin(), components.end());
  return components;
}

}  // namespace deliso::test
