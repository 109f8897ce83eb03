// Pairs of triangles of a mesh that meet where they should not, decided exactly on the given coordinates.
//
// Two triangles may share the simplex that they name together: nothing, a vertex or an edge. What they have in common
// beyond it makes them
//   crossing  when a point lies in the relative interior of both (they pierce each other, or overlap in their plane),
//   touching  when they have other points in common, but not of both interiors (a corner on a face, two edges that
//             meet, different vertices at the same place).
// Both are decided by the signs of orient3d alone (interval overlap on the common line of the two planes, after
// Guigue and Devillers: Fast and robust triangle-triangle overlap test using orientation predicates, 2003; separating
// edges in the plane). Triangles of zero area have no plane; they are counted and left out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/triangle_mesh.h"

namespace deliso {

enum class TriangleContact { kNone, kTouching, kCrossing };

struct TrianglePair {
  std::uint32_t first = 0;  // indices of the triangles, first < second
  std::uint32_t second = 0;
  TriangleContact contact = TriangleContact::kNone;
  Vec3 position;  // the middle of what their bounding boxes have in common
};

struct SelfIntersections {
  std::int64_t crossing_pairs = 0;
  std::int64_t touching_pairs = 0;
  std::int64_t zero_area_triangles = 0;  // left out
  std::vector<TrianglePair> crossing;    // the first ones in order of (first, second)
  std::vector<TrianglePair> touching;    // the same
};

// How two triangles, given by the indices and the places of their corners, meet beyond what they share. Precondition:
// neither has zero area.
TriangleContact triangle_contact(const std::array<std::uint32_t, 3>& s, const std::array<Vec3, 3>& s_points,
                                 const std::array<std::uint32_t, 3>& t, const std::array<Vec3, 3>& t_points);
inline TriangleContact triangle_contact(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& s,
                                        const std::array<std::uint32_t, 3>& t) {
  return triangle_contact(s, {points[s[0]], points[s[1]], points[s[2]]}, t, {points[t[0]], points[t[1]], points[t[2]]});
}

// Whether three points are not in line, exactly.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

// All pairs; at most `keep` of each kind are kept, the same for any number of threads. Precondition: indices in range,
// coordinates as orient3d wants them (delaunay/predicates.h).
SelfIntersections self_intersections(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep = 10,
                                     int threads = 1);
// The same of the pairs with a marked triangle (a mark that is not 0). Precondition: as many marks as triangles, or
// none: then all count.
SelfIntersections self_intersections_of(std::span<const std::uint8_t> marks, std::span<const Vec3> points,
                                        std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep = 10,
                                        int threads = 1);
inline SelfIntersections self_intersections(const TriangleMesh& mesh, std::size_t keep = 10) {
  return self_intersections(mesh.points, mesh.triangles, keep);
}

}  // namespace deliso
