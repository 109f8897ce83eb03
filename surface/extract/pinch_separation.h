// Moves copies of a vertex apart, so that a mesh which touches itself there does so no more.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "delaunay/base/box3.h"
#include "delaunay/ids.h"
#include "surface/extract/pinch_groups.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Each copy moves a hair's breadth (at most 2e-4 mesh-space units, or 8e-4 where that does not do) towards one side of
// its own triangles, in a direction that all of them see from that side, so that its fan shrinks away from the others;
// vertices on the box stay on their face. Which side, and how far, is found by trial with exact tests of the triangles
// around. `origin_of` names, for each mesh vertex, what it is a copy of: triangles that share no vertex but an origin
// are tested, too. When only some vertices are wanted (is_wanted(vertex)), the others are of no use afterwards: copies
// that are neither wanted nor can make a difference to wanted ones stay where they are.
void separate_pinches(SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of,
                      const Box3& box, const std::function<bool(std::uint32_t)>& is_wanted = {});

}  // namespace deliso
