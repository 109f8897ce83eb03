// Where a mesh differs from the isosurface, as far as signs of it can be seen.
#pragma once

#include <vector>

#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/raised_cells.h"
#include "surface/signed_delaunay.h"
#include "volume/exact_topology.h"

namespace deliso {

// A mesh of the whole surface and what it was matched with.
struct MatchedMesh {
  BuiltMesh built;
  std::vector<std::uint32_t> component;  // of each mesh vertex: the exact component it lies on
  ComponentMatch match;
};

// The voxel cells near the trouble of the components that `done` leaves out; may repeat cells. Signs of trouble:
// vertices that had to be split; triangles between two components; pieces beside the main piece of their component;
// vertices of the triangulation that no triangle uses; critical points of the
// interpolant in tetrahedra of the other sign. For a component without any such sign its saddles are taken, and when
// there are none all its crossings.
std::vector<CellName> cells_in_trouble(const ScalarGrid& grid, const IsosurfaceTopology& topology,
                                       const SignedDelaunay& restricted, const MatchedMesh& mesh,
                                       const RaisedCells& cells, const std::vector<bool>& done);

}  // namespace deliso
