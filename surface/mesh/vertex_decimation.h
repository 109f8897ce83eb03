// Removal of vertices from a mesh: each vertex goes, and its link is filled with triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/minimum_area_triangulation.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The triangles around an inner vertex, in order. For each triangle: its first vertex in the link, and the side on the
// other side of its link edge.
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
  // The fan of an existing vertex; false when it is on the boundary.
  bool find(std::uint32_t vertex, VertexFan& fan) const;
  // Whether an edge joins two vertices.
  [[nodiscard]] bool are_joined(std::uint32_t v, std::uint32_t w) const;

  // Whether the link of an inner vertex can be filled: it is not too long, passes no vertex twice and, if it is a
  // triangle, that triangle is not in the mesh.
  [[nodiscard]] bool can_be_filled(const VertexFan& fan) const;
  // The filling of least area, if there is one. Its triangles have an area, and its edges are not in the mesh
  // elsewhere.
  [[nodiscard]] MinimumAreaTriangulation least_filling(const VertexFan& fan) const;
  // Removes an inner vertex and fills its link. Precondition: the link can be filled. Two triangle slots become free,
  // the others hold the filling.
  void replace(std::uint32_t vertex, const VertexFan& fan, const MinimumAreaTriangulation& filling);
  // Removes all of the given vertices for which this is possible; a vertex that the mesh still has() was left in place.
  void take_out(std::span<const std::uint32_t> vertices);
  // All triangles made by removals, whether they still exist or not.
  [[nodiscard]] const std::vector<std::uint32_t>& renewed() const { return renewed_; }
  // Closes the gaps in the mesh's arrays. Nothing else may be called afterwards.
  void drop_free_slots() { drop_triangles(mesh_, is_gone_); }

 private:
  bool take_out(std::uint32_t vertex);
  static constexpr std::uint32_t kNoCorner = 0xFFFFFFFFu;
  // A vertex with a longer link is not removed.
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
