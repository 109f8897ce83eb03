// Whether the boundary of a mesh lies on the box of its volume.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The boundary edges whose ends lie on no common face of the box, within `on_box`; each once. For an oriented manifold
// in the box's coordinates; neighbours are not needed. In linear time.
std::vector<MeshEdge> boundary_edges_off_box(const SurfaceMesh& mesh, const Box3& box, double on_box);

}  // namespace deliso
