// The isosurface as all stages use it: its ray search, and its exact topology.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// Holds references to objects that the maker must keep alive; passed on by reference.
struct ExactSurface {
  const Isosurface& isosurface;
  const IsosurfaceTopology& topology;  // empty if the run does not use it
  int threads = 1;                     // only the time depends on it
  // Whether each component is left out on purpose, so that the mesh need not come near it; empty: none is.
  std::vector<std::uint8_t> is_dropped = {};
  // Of the run: once it is to stop, checks end early with what they have found; poll before it counts. Null: of none.
  const Controls* controls = nullptr;

  [[nodiscard]] bool is_over() const { return controls != nullptr && controls->is_over(); }

  [[nodiscard]] bool wants(const EdgeCrossing& crossing) const {
    return is_dropped.empty() || is_dropped[crossing.component] == 0;
  }
  [[nodiscard]] const ScalarGrid& grid() const { return isosurface.grid(); }
  // Where a crossing lies, in mesh space.
  [[nodiscard]] Vec3 position(const EdgeCrossing& crossing) const {
    return scaled(crossing_position(grid(), crossing), isosurface.step());
  }
  // The component on which a point of mesh space lies (component_of in exact_topology.h).
  [[nodiscard]] std::optional<std::uint32_t> component_at(const Vec3& p) const {
    const Vec3& step = isosurface.step();
    return component_of(grid(), isosurface.isovalue(), topology, {p.x / step.x, p.y / step.y, p.z / step.z});
  }
};

}  // namespace deliso
