// Where the isosurface is farther from a mesh than is promised, within voxel cells too: by a proof, no places are left
// out but such as are farther by less than a fortieth of the distance.
//
// A box of which all is within R of its middle is settled when the mesh is within D - R of the middle. And where all
// corners of a box within a cell are on one side, no isosurface is in it, since the field is linear along each axis
// there. Boxes that neither settles are divided (branch and bound).
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

// The cells that the isosurface passes through, ascending.
std::vector<std::uint64_t> crossed_cells(const ExactSurface& surface);

// For each of these cells in which the isosurface has points farther than `most` from all triangles, one of them. Cells
// with components that are dropped are left out. Points that are farther by less than a fortieth of `most` may be
// missing. In order of the cells; the same for any number of threads. In mesh space.
std::vector<MissedPlace> missed_places(const SurfaceMesh& mesh, const ExactSurface& surface, double most,
                                       std::span<const std::uint64_t> cells);

}  // namespace deliso
