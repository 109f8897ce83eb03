// The triangles around the vertices of a mesh from which vertices are taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/minimum_area_triangulation.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The triangles around an inner vertex, in order; for each the vertex that comes first in the link and the side beyond
// the link.
struct VertexFan {
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> link;
  std::vector<TriangleSide> outer;
};

class VertexDecimation {
 public:
  // Keeps a reference to the mesh and changes it.
  explicit VertexDecimation(SurfaceMesh& mesh);

  [[nodiscard]] bool has(std::uint32_t vertex) const { return corner_of_[vertex] != kNoCorner; }
  [[nodiscard]] bool has_triangle(std::uint32_t t) const { return !is_gone_[t]; }
  // Of a vertex that is there; false when it is on the boundary.
  bool find(std::uint32_t vertex, VertexFan& fan) const;
  // Whether an edge joins two vertices.
  [[nodiscard]] bool are_joined(std::uint32_t v, std::uint32_t w) const;

  // Whether the link of an inner vertex can be filled: it is not too long, passes no vertex twice and, if it is a
  // triangle, is not one of the mesh.
  [[nodiscard]] bool can_be_filled(const VertexFan& fan) const;
  // Its filling of the least area, if there is one: by triangles that have an area and edges that the mesh does not
  // have elsewhere.
  [[nodiscard]] MinimumAreaTriangulation least_filling(const VertexFan& fan) const;
  // Takes an inner vertex away and fills its link, which can be filled. Two slots of triangles are free then,
  // the others hold the filling.
  void replace(std::uint32_t vertex, const VertexFan& fan, const MinimumAreaTriangulation& filling);
  // Does so with all of some vertices for which it can be done; those that the mesh still has() stay.
  void take_out(std::span<const std::uint32_t> vertices);
  // All triangles that came so, gone or not.
  [[nodiscard]] const std::vector<std::uint32_t>& renewed() const { return renewed_; }
  // Closes the gaps in the mesh's arrays. Nothing can be asked afterwards.
  void drop_free_slots() { drop_triangles(mesh_, is_gone_); }

 private:
  bool take_out(std::uint32_t vertex);
  static constexpr std::uint32_t kNoCorner = 0xFFFFFFFFu;
  // Links of more vertices are left as they are.
  static constexpr std::size_t kLongestLink = 32;

  TriangleSide build(const VertexFan& fan, const MinimumAreaTriangulation& filling, std::size_t i, std::size_t j,
                     std::size_t& next);
  void join(TriangleSide side, TriangleSide across) {
    mesh_.neighbours[side >> 2][side & 3u] = across;
    if (across != kNoSide) mesh_.neighbours[across >> 2][across & 3u] = side;
  }

  SurfaceMesh& mesh_;
  std::vector<std::uint32_t> corner_of_;  // of each vertex: one of its corners, 3 triangle + i; none when it is gone
  std::vector<bool> is_gone_;             // of each triangle
  std::vector<std::uint32_t> renewed_;
};

}  // namespace deliso
