// Polygons and triangle strips as VTK stores them: the numbers of all corners, one after another, and where each ends.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// Throws the error that it makes of what was expected and what was found.
using FailExpecting = std::function<void(const std::string& expected, std::int64_t found)>;

// Appends fans of the polygons, or the triangles of strips with every other one turned over. `base` is added to each
// corner. `ends`: of each polygon in `corners`, ascending. Calls `fail` when a corner is below 0 or not below `points`,
// or a polygon has fewer than three.
void append_polygons(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, bool are_strips,
                     std::int64_t base, std::int64_t points, const FailExpecting& fail, TriangleMesh& mesh);

}  // namespace deliso
