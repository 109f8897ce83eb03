// Where the isosurface is farther from a mesh than is promised, within voxel cells too: by a proof, no places are left
// out but such as are farther by less than a fortieth of the distance.
//
// A box within a cell is settled when one triangle is near all of a convex body that holds the isosurface there, or
// several together are (covering_triangles.h). And
// where all corners of a box are on one side, no isosurface is in it, since the field is linear along each axis there.
// Boxes that neither settles are divided (branch and bound).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// A point of the isosurface that the mesh misses, in a cell (the linear index of its lowest sample).
struct MissedPlace {
  std::uint64_t cell = 0;
  Vec3 position;

  friend bool operator==(const MissedPlace&, const MissedPlace&) = default;
};

// The cells that components pass through which are not left out, ascending.
std::vector<std::uint64_t> crossed_cells(const ExactSurface& surface);

// For each of these cells in which the isosurface has points farther than `most` from all triangles, one of them.
// Points of components that are left out do not count. Points that are farther by less than a fortieth of `most` may be
// missing. In order of the cells; the same for any number of threads. In mesh space.
std::vector<MissedPlace> missed_places(const SurfaceMesh& mesh, const ExactSurface& surface, double most,
                                       std::span<const std::uint64_t> cells);

}  // namespace deliso
