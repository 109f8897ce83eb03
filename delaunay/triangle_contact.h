// How two triangles of a mesh meet, decided exactly on the given coordinates.
//
// Two triangles may share the simplex that they name together: nothing, a vertex or an edge. What they have in common
// beyond it makes them
//   crossing  when a point lies in the relative interior of both (they pierce each other, or overlap in their plane),
//   touching  when they have other points in common, but not of both interiors (a corner on a face, two edges that
//             meet, different vertices at the same place).
// Both are decided by the signs of orient3d alone (interval overlap on the common line of the two planes, after
// Guigue and Devillers: Fast and robust triangle-triangle overlap test using orientation predicates, 2003; separating
// edges in the plane).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "delaunay/base/vec3.h"

namespace deliso {

enum class TriangleContact { kNone, kTouching, kCrossing };

// How two triangles meet beyond what they share, given the indices and the coordinates of their corners. Precondition:
// neither has zero area, coordinates as orient3d requires them (delaunay/predicates.h).
TriangleContact triangle_contact(const std::array<std::uint32_t, 3>& s, const std::array<Vec3, 3>& s_points,
                                 const std::array<std::uint32_t, 3>& t, const std::array<Vec3, 3>& t_points);
inline TriangleContact triangle_contact(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& s,
                                        const std::array<std::uint32_t, 3>& t) {
  return triangle_contact(s, {points[s[0]], points[s[1]], points[s[2]]}, t, {points[t[0]], points[t[1]], points[t[2]]});
}

// Whether three points are not in line, exactly.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace deliso
