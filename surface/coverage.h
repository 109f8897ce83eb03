// Whether a mesh covers the isosurface: a finger of the surface may hide within one Voronoi cell, where neither
// topology nor any dual edge tells of it.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/restricted_delaunay.h"
#include "surface/surface_mesh.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The grid-edge crossings (places in topology.crossings, ascending) of the `wanted` components that lie farther from
// every triangle than 0.8 mesh-space units and than 0.3 circumradii of the nearest triangle, which is more than the
// coarse mesh of stage 1 is off a surface that it approximates.
std::vector<std::uint32_t> uncovered_crossings(const SurfaceMesh& mesh, const ScalarGrid& grid, const Vec3& step,
                                               const IsosurfaceTopology& topology, const std::vector<bool>& wanted);

// Inserts uncovered crossings into the triangulation, unless one of its vertices is nearer than `min_distance`. Returns
// how many went in; stage 1 has to go on then.
std::int64_t insert_uncovered(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology& topology, double min_distance);

}  // namespace deliso
