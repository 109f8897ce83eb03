// Where the topology of a mesh differs from the exact one, found when no other defect shows it.
//
// An Euler curve gives, for a plane swept along an axis, the Euler characteristic of the part below the plane. We
// compare the curve of the mesh with that of a mesh with the exact topology. A local difference in shape makes the
// curves differ for a few layers; an additional or missing tunnel makes them differ from there on. The layers of such
// lasting differences are the jumps of the piecewise constant function that fits the difference of the curves best.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Along each axis, for each sample layer: the Euler characteristic of the part below it.
using EulerCurves = std::array<std::vector<std::int64_t>, 3>;

// A sample layer along each axis.
using SampleLayers = std::array<std::int32_t, 3>;

// Stands for no part: such vertices are not counted.
inline constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;

// Gets (part, layers, change): the Euler characteristic of the part changes by so much when planes along the three axes
// reach these layers.
using VisitChange = std::function<void(std::uint32_t, const SampleLayers&, std::int32_t)>;
// Visits the changes of all simplices of a mesh. `part_of_vertex`, `step` and `dims`: as below.
void for_each_mesh_change(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex, const Vec3& step,
                          const std::array<std::int32_t, 3>& dims, const VisitChange& visit);

// The Euler curves of several parts of a mesh, in one pass over its triangles. `part_of_vertex` is the same for all
// vertices of a piece, below `parts` or kNoPart. `step` is the size of a voxel in mesh space, `dims` the number of
// samples.
std::vector<EulerCurves> euler_curves(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                      std::size_t parts, const Vec3& step, const std::array<std::int32_t, 3>& dims);

// Along each axis, ascending: the sample layers at which the two curves begin or cease to differ lastingly.
std::array<std::vector<std::int32_t>, 3> jumps_between(const EulerCurves& mesh, const EulerCurves& exact);

}  // namespace deliso
