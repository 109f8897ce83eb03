// Components from marching cubes on a finer grid: meshes that lie as near to the isosurface as is asked for, or have no
// needles in flat cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/exact_polygonization.h"

namespace deliso {

// How many times as fine the grid is along each axis.
using GridFactors = std::array<std::int32_t, 3>;

// Those with which triangles within a finer cell lie within `max_distance` of the isosurface: the diagonal is shorter.
GridFactors factors_within(double max_distance, const Isosurface& isosurface);

// Crossings that round to a sample would coincide there, and their triangles cross. At a distance from it, far less
// than vertices may be off the isosurface, they do not.
void keep_apart(IsosurfaceTopology& topology);

// The meshes of these components in mesh space, with neighbours and pole heights of one voxel. The interpolant within a
// part of a voxel cell is trilinear again, so samples of it on a grid that is finer by whole factors have the same
// isosurface, and marching cubes has the exact topology there. Other factors, a little larger, are taken where a sample
// would equal the isovalue. Components are left out where the finer grid would be too large (2^25 samples), or where
// the rounding of its samples gives another topology.
ExactPolygonization finer_cubes(const std::vector<bool>& components, const ExactSurface& surface,
                                const GridFactors& factors);

}  // namespace deliso
