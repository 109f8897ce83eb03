// Groups of vertices that stand at one place in a mesh that touches itself there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Copies move less than this from their homes (mesh-space units).
inline constexpr double kPinchSeparation = 9e-4;

// A mesh vertex that shares its place, or nearly, with others; and where else it may start from, best first. The last
// of all its homes may be none on the surface, for want of a better one.
struct Copy {
  std::uint32_t vertex = 0;
  std::vector<Vec3> other_homes;
  bool has_false_home = false;
};
using PinchGroup = std::vector<Copy>;

// When what becomes of a group depends on some vertices around it, groups with copies among these hang together, and
// each set of groups that do fares as it would without the others. The groups, ascending, that hang together with one
// that has a wanted copy. visit_around(group, visit) calls visit(vertex) for the vertices around a group.
using VertexVisit = std::function<void(std::uint32_t)>;
std::vector<std::size_t> groups_that_matter(std::span<const PinchGroup> groups,
                                            const std::function<void(std::size_t, const VertexVisit&)>& visit_around,
                                            const std::function<bool(std::uint32_t)>& is_wanted);

}  // namespace deliso
