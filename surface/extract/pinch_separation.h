// Moves copies of a vertex apart, so that the mesh no longer touches itself there.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "delaunay/base/box3.h"
#include "delaunay/ids.h"
#include "surface/extract/pinch_groups.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Each copy moves by at most 2e-4 mesh-space units (8e-4 where that is not enough), to one side of all its own
// triangles if such a direction exists, so that its fan shrinks away from the others. Vertices on the box stay on their
// face, and none leaves the walls of a closed volume. The side and the distance are found by trial, with exact tests of
// the triangles around. `origin_of` gives, for each mesh vertex, the vertex that it is a copy of: triangles that share
// no vertex but an origin are tested, too. If is_wanted is given, only the vertices with is_wanted(vertex) are used
// afterwards: copies that are neither wanted nor influence a wanted one stay where they are.
void separate_pinches(SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of,
                      const Box3& box, const Box3& surface_box,
                      const std::function<bool(std::uint32_t)>& is_wanted = {});

}  // namespace deliso
