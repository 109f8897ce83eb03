// The mesh between the stages and after them: triangles that know their neighbours, without tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/check.h"
#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// The side of a triangle across from one of its corners, encoded as 4 * triangle + corner. kNoSide: a boundary edge.
using TriangleSide = std::uint32_t;
inline constexpr TriangleSide kNoSide = 0xFFFFFFFFu;
// The largest number of triangles whose sides this encoding can tell apart.
inline constexpr std::size_t kMostTriangles = (std::size_t{1} << 30) - 1;
inline void check_triangle_count(std::size_t count) {
  if (count <= kMostTriangles) return;
  throw InputError("the mesh needs more than " + std::to_string(kMostTriangles) +
                   " triangles, expected no more: coarser thresholds or budget.max_vertices bound them");
}

// A manifold, oriented triangle mesh in mesh space (raycast/isosurface.h). Side i of a triangle runs from corner i + 1
// to corner i + 2. neighbours[t][i] is the same edge as a side of the triangle across it.
struct SurfaceMesh {
  std::vector<Vec3> points;          // of each vertex
  std::vector<double> pole_heights;  // of each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<TriangleSide, 3>> neighbours;
};

// The bounding box of a triangle.
inline Box3 box_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
  Box3 box;
  for (const std::uint32_t v : mesh.triangles[triangle]) box.extend(mesh.points[v]);
  return box;
}
inline double squared_longest_edge(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
  return std::max({squared_distance(p, q), squared_distance(q, r), squared_distance(r, p)});
}

// Visits the corners that form one vertex with a given corner when sides are joined by `across` (which gives the side
// across a side, or kNoSide). Corner 3 t + i is the corner of triangle t at its vertex i. The walk goes around the
// vertex one way and, if the fan is open, then the other way. visit(corner) marks the corner and returns whether it was
// unmarked. Each corner is visited once, but the first corner of a closed fan again at the end.
template <class Across, class Visit>
void for_each_corner_of_fan(std::uint32_t corner, const Across& across, const Visit& visit) {
  visit(corner);
  for (const unsigned turn : {1u, 2u}) {
    for (std::uint32_t c = corner;;) {
      const TriangleSide side = across(4 * (c / 3) + (c % 3 + turn) % 3);
      if (side == kNoSide) break;
      c = 3 * (side >> 2) + ((side & 3u) + turn) % 3;
      if (!visit(c)) return;
    }
  }
}

// Appends the wanted pieces of a mesh to another, with their pole heights if it has any. `piece_of` gives the piece of
// each vertex of `from`.
void append_pieces(const SurfaceMesh& from, const std::vector<std::uint32_t>& piece_of, const std::vector<bool>& wanted,
                   SurfaceMesh& to);

// Removes triangles from a mesh, and the vertices that are then unused; neighbours may be missing. No remaining
// triangle may be a neighbour of a removed one.
void drop_triangles(SurfaceMesh& mesh, const std::vector<bool>& is_gone);

// A point of the grid's world coordinates in mesh space.
Vec3 from_world(Vec3 p, const Isosurface& isosurface);
// In the grid's world coordinates; vertices keep their order.
TriangleMesh to_world(SurfaceMesh mesh, const Isosurface& isosurface);
// Where its vertices come to lie then.
std::vector<Vec3> places_in_world(const SurfaceMesh& mesh, const Isosurface& isosurface);

}  // namespace deliso
