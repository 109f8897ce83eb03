// The mesh between the stages and after them: triangles that know their neighbours. No tetrahedra any more.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/triangle_mesh.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The side of a triangle across from one of its corners, encoded as 4 * triangle + corner. kNoSide: a boundary edge.
using TriangleSide = std::uint32_t;
inline constexpr TriangleSide kNoSide = 0xFFFFFFFFu;

// A manifold, oriented triangle mesh in mesh space (raycast/isosurface.h): side i of a triangle runs from corner i + 1
// to corner i + 2, and neighbours[t][i] is that same edge as the triangle across knows it.
struct SurfaceMesh {
  std::vector<Vec3> points;          // of each vertex
  std::vector<double> pole_heights;  // of each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<TriangleSide, 3>> neighbours;
};

// Appends the wanted pieces of a mesh to another; `piece_of`: of each vertex of `from`.
void append_pieces(const SurfaceMesh& from, const std::vector<std::uint32_t>& piece_of, const std::vector<bool>& wanted,
                   SurfaceMesh& to);

// In the grid's world coordinates; vertices keep their order. `step`: mesh-space units per index step.
TriangleMesh to_world(const SurfaceMesh& mesh, const ScalarGrid& grid, const Vec3& step);

}  // namespace deliso
