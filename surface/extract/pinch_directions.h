// In which directions a copy of a vertex may move away from the other copies (pinch_separation.h).
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/extract/pinch_neighbourhoods.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Unit vectors for a copy at its own position, the most promising first. First come directions towards either side of
// all its triangles. When there is none for a side, or these did not help (`is_stubborn`), 26 directions all around
// follow. A copy on the box stays on its face.
std::vector<Vec3> pinch_directions(const SurfaceMesh& mesh, const PinchNeighbourhoods& around, const Box3& box,
                                   std::uint32_t copy, bool is_stubborn);

}  // namespace deliso
