// Whether a mesh covers the isosurface: a finger of the surface may hide within one Voronoi cell, where neither
// topology nor any dual edge tells of it.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/restricted/restricted_delaunay.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// The grid-edge crossings that the mesh of the triangulation does not cover (see CoverageQuery): for stage 1 to insert.
// `suspects` are the crossings to ask about (places in topology.crossings); those that are not covered stay in it.
// `coverage targets`, when asked for, gets those that the mesh is not close to (CoverageQuery::look), covered or not.
// The same for any number of threads.
std::vector<Vec3> uncovered_points(const RestrictedDelaunay& restricted, const ScalarGrid& grid,
                                   const IsosurfaceTopology& topology, std::vector<std::uint32_t>& suspects,
                                   int threads = 1, std::vector<Vec3>* coverage_targets = nullptr);

// All crossings, in an order that keeps neighbours together.
std::vector<std::uint32_t> all_crossings(const ScalarGrid& grid, const IsosurfaceTopology& topology, int threads = 1);

}  // namespace deliso
