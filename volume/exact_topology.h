// The exact topology of an isosurface of the trilinear interpolant, found from the grid without a mesh.
//
// Within a cell, sweep w from 0 to 1: the slice is bilinear and holds 0, 1 or 2 arcs, each named by the cell sides it
// crosses; it changes only at roots on vertical edges and at saddles of ambiguous slices. Arcs between events are edges
// and event slices are nodes of a small graph, whose Euler characteristic is that of the cell's surface piece. Pieces
// join through the grid-edge crossings they share. Linear time, exact for a regular isovalue.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/scalar_grid.h"

namespace deliso {

// (euler_characteristic, boundary_loops) classifies a connected orientable surface up to homeomorphism.
struct ComponentTopology {
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
  friend bool operator==(const ComponentTopology&, const ComponentTopology&) = default;
  friend auto operator<=>(const ComponentTopology&, const ComponentTopology&) = default;
};

// A sign change along the grid edge from `sample` (linear index of its lower end) towards +axis.
struct EdgeCrossing {
  std::uint64_t sample = 0;
  std::uint8_t axis = 0;        // 0 x, 1 y, 2 z
  std::uint32_t component = 0;  // index into IsosurfaceTopology::components
  double t = 0;                 // position along the edge, in (0, 1)
};

struct IsosurfaceTopology {
  std::vector<ComponentTopology> components;  // numbered by their first crossing in (sample, axis) order
  std::vector<EdgeCrossing> crossings;        // in (sample, axis) order; every component has at least one
};

// Precondition: no sample equals `isovalue` (see regular_isovalue).
IsosurfaceTopology exact_topology(const ScalarGrid& grid, double isovalue);

// The crossing's place in index space.
Vec3 crossing_position(const ScalarGrid& grid, const EdgeCrossing& crossing);

}  // namespace deliso
