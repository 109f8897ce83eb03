// In which directions a copy of a vertex may move apart from the others (pinch_separation.h).
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/extract/pinch_neighbourhoods.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Unit vectors for a copy, which is at home, the most promising first: towards either side of all its triangles; then,
// when no direction sees them all from a side, or when these did not help (`is_stubborn`), a few all around. A copy on
// the box stays on its face.
std::vector<Vec3> pinch_directions(const SurfaceMesh& mesh, const PinchNeighbourhoods& around, const Box3& box,
                                   std::uint32_t copy, bool is_stubborn);

}  // namespace deliso
