// Groups of vertices at one position, where a mesh touches itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Copies move less than this from their own position (mesh-space units).
inline constexpr double kPinchSeparation = 9e-4;

// An edge subdivided in each of the pairs of triangles that share it, and the common normal of the pair.
struct SubdividedEdge {
  Vec3 from, to;
  Vec3 normal;
};

// A mesh vertex that shares its position, or nearly, with others. One on a subdivided edge has other positions that it
// may start from (edge_positions.h); the last of these may lie off the surface, because no better one was found.
struct Copy {
  std::uint32_t vertex = 0;
  std::vector<Vec3> other_positions = {};  // best first; empty until find_other_positions() was called
  bool is_on_edge = false;
  SubdividedEdge edge = {};  // if it is on one
};
using PinchGroup = std::vector<Copy>;

// The groups that must be separated for the sake of the wanted copies. The result for a group depends on the vertices
// around it. So two groups depend on each other when one has a copy among the vertices around the other; sets of groups
// without such a relation do not influence each other. Returns, ascending, all groups that depend, directly or not, on
// a group with a wanted copy. visit_around(group, visit) calls visit(vertex) for the vertices around a group.
using VertexVisit = std::function<void(std::uint32_t)>;
std::vector<std::size_t> groups_that_matter(std::span<const PinchGroup> groups,
                                            const std::function<void(std::size_t, const VertexVisit&)>& visit_around,
                                            const std::function<bool(std::uint32_t)>& is_wanted);

}  // namespace deliso
