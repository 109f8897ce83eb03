// Vertices that coincide once coordinates are rounded. Where a volume is closed along its box, cubes have strips of
// triangles in the layer outside it (volume/filters/closing.h), which vanish when the mesh is written.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Merges the ends of edges whose ends have the same place, as long as the mesh stays what it is: a manifold of the same
// topology (the link condition of Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving edge contraction, 1999).
// Returns how many; if any, the mesh has no neighbours afterwards. `places`: where each vertex is written; `of_vertex`:
// a value of each vertex, from which those of merged ones are taken out.
std::int64_t merge_equal_vertices(std::span<const Vec3> places, SurfaceMesh& mesh,
                                  std::vector<std::uint32_t>* of_vertex = nullptr);

}  // namespace deliso
