// Which way the components of a mesh face, told by where they pass grid edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/isosurface_probe.h"

namespace deliso {

// Along a grid edge whose samples lie on different sides the isosurface passes once. So a component that follows it
// passes the edge once more in that direction than against it. Of each component: the number of its passes towards
// lower values less those towards higher ones, over all such edges; at least 0 unless these are more than twice as
// many, and most of its area faces up the gradient as well, by that at triangles and by that at their corners.
// Negative: it is reversed. An edge is looked at along lines beside it, on which seldom a vertex lies, and passes
// nearer to its ends than vertices may be off the isosurface do not count: they tell nothing of parts as thin as that,
// which 0 may stand for. All in voxel space.
std::vector<std::int64_t> facing_votes(const TriangleMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
                                       std::size_t components, const IsosurfaceProbe& probe);

}  // namespace deliso
