// The isosurface as all stages know it: what rays find of it, and its exact topology.
#pragma once

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// Refers to what its maker keeps; to be handed on by reference.
struct ExactSurface {
  const Isosurface& isosurface;
  const IsosurfaceTopology& topology;  // empty where a run does not ask for it
  int threads = 1;                     // to work with: nothing but the time depends on them

  [[nodiscard]] const ScalarGrid& grid() const { return isosurface.grid(); }
  // Where a crossing lies, in mesh space.
  [[nodiscard]] Vec3 position(const EdgeCrossing& crossing) const {
    return scaled(crossing_position(grid(), crossing), isosurface.step());
  }
};

}  // namespace deliso
