// Small volumes for the tests of the mesher, and points on their isosurfaces.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "surface/recover/boundary_curves.h"
#include "surface/recover/component_seeds.h"
#include "surface/restricted/signed_delaunay.h"
#include "tests/support/raycast_fields.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/regular_isovalue.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso::testing {

// A volume with its isosurface and exact topology.
struct Scene {
  std::string name;
  ScalarGrid grid;
  double isovalue;
  std::unique_ptr<Isosurface> isosurface;
  IsosurfaceTopology topology;

  Scene(std::string scene_name, ScalarGrid scene_grid, double wanted)
      : name(std::move(scene_name)),
        grid(std::move(scene_grid)),
        isovalue(regular_isovalue(grid, wanted)),
        isosurface(std::make_unique<Isosurface>(grid, isovalue, SearchOptions{})),
        topology(exact_topology(grid, isovalue)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] ExactSurface surface(int threads = 1) const { return {*isosurface, topology, threads}; }

  // Seeds of every component and the boundary curves: where stage 1 starts.
  [[nodiscard]] std::vector<Vec3> start() const {
    std::vector<Vec3> points = component_seeds(surface());
    const std::vector<Vec3> curves = boundary_curve_points(*isosurface);
    points.insert(points.end(), curves.begin(), curves.end());
    return points;
  }
};

// The isosurface's points on grid edges.
inline std::vector<Vec3> crossing_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (const EdgeCrossing& c : scene.topology.crossings) points.push_back(crossing_position(scene.grid, c));
  return points;
}

// A triangulation of every crossing of the isosurface with a grid edge.
inline SignedDelaunay dense(const Scene& scene) { return {*scene.isosurface, crossing_points(scene)}; }

inline std::unique_ptr<Scene> field_scene(const std::string& name, std::int32_t size, std::uint64_t seed = 1) {
  return std::make_unique<Scene>(name + " " + std::to_string(size) + " seed " + std::to_string(seed),
                                 generate_field(name, size, seed), find_analytic_field(name).isovalue);
}

inline std::unique_ptr<Scene> noise_scene(const Dims& dims, std::uint64_t seed, const Vec3& spacing = {1, 1, 1}) {
  Rng rng(seed);
  return std::make_unique<Scene>("noise seed " + std::to_string(seed), noise_grid(dims, spacing, rng), 127.5);
}

inline std::unique_ptr<Scene> wave_scene(const Dims& dims, const Vec3& spacing, std::uint64_t seed) {
  Rng rng(seed);
  return std::make_unique<Scene>("waves seed " + std::to_string(seed), wave_grid(dims, spacing, rng), 0.1);
}

}  // namespace deliso::testing
