// Moves copies of a vertex apart, so that a mesh which touches itself there does so no more.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/surface_mesh.h"

namespace deliso {

// A set of mesh vertices that share their place, or nearly.
using CopyGroup = std::vector<std::uint32_t>;

// Each copy moves a hair's breadth (at most 2e-4 mesh-space units) towards one side of its own triangles, in a
// direction that all of them see from that side, so that its fan shrinks away from the others; vertices on the box stay
// on their face. Which side, and how far, is found by trial with exact tests of the triangles around the copies.
void separate_copies(SurfaceMesh& mesh, std::span<const CopyGroup> groups, const Box3& box);

}  // namespace deliso
