// Which triangles meet at the edges and vertices of a mesh. The one structure behind every combinatorial check.
//
// Half-edge h = 3 t + i runs along triangle t from its corner i to its corner i + 1 (mod 3). Half-edges with the same
// two end vertices, whatever their directions, form an edge. Nothing is assumed of the mesh: an edge may have any
// number of half-edges, triangles may repeat a vertex (such an edge has low == high) or each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/triangle_mesh.h"

namespace deliso {

struct MeshEdge {
  std::uint32_t low = 0;   // vertex with the smaller index
  std::uint32_t high = 0;  // vertex with the larger index
};

// Built in linear time for meshes of bounded valence: half-edges are bucketed by their lower vertex, each bucket is
// sorted by the higher. So edges are in lexicographic order and the half-edges of an edge ascend.
class MeshConnectivity {
 public:
  // Keeps a reference to the mesh. Precondition: every index is below mesh.points.size() (see first_bad_triangle). The
  // same for any number of threads.
  explicit MeshConnectivity(const TriangleMesh& mesh, int threads = 1);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }
  [[nodiscard]] const MeshEdge& edge(std::size_t e) const { return edges_[e]; }
  // The half-edges of edge e, ascending; never empty.
  [[nodiscard]] std::span<const std::uint32_t> half_edges(std::size_t e) const {
    return {half_edges_.data() + first_[e], first_[e + 1] - first_[e]};
  }
  [[nodiscard]] bool is_boundary(std::size_t e) const { return first_[e + 1] - first_[e] == 1; }

  // Where a half-edge starts and ends.
  [[nodiscard]] std::uint32_t tail(std::uint32_t half_edge) const {
    return mesh_.triangles[half_edge / 3][half_edge % 3];
  }
  [[nodiscard]] std::uint32_t head(std::uint32_t half_edge) const {
    return mesh_.triangles[half_edge / 3][(half_edge + 1) % 3];
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<MeshEdge> edges_;
  std::vector<std::uint32_t> first_;       // of each edge, its place in half_edges_; one more at the end
  std::vector<std::uint32_t> half_edges_;  // grouped by edge
};

// A connected piece of the mesh: triangles joined through shared vertices.
struct MeshComponent {
  std::int64_t vertices = 0;
  std::int64_t edges = 0;
  std::int64_t triangles = 0;
  std::int64_t boundary_loops = 0;  // connected sets of boundary edges; of a manifold mesh they are closed curves
  [[nodiscard]] std::int64_t euler_characteristic() const { return vertices - edges + triangles; }
};

struct MeshTopology {
  std::int64_t boundary_edges = 0;         // edges with one triangle
  std::int64_t non_manifold_edges = 0;     // edges with three or more triangles
  std::int64_t non_manifold_vertices = 0;  // vertices whose triangles form more than one umbrella
  std::int64_t misoriented_edges = 0;      // edges with two triangles that run along it in the same direction
  std::int64_t unreferenced_vertices = 0;  // vertices without a triangle; they belong to no component
  std::int64_t repeated_vertices = 0;      // triangles that name a vertex twice
  std::vector<MeshComponent> components;   // numbered by their lowest vertex
  // The component of each vertex, kNoComponent for an unreferenced one. A triangle is in that of its vertices.
  std::vector<std::uint32_t> component_of_vertex;

  static constexpr std::uint32_t kNoComponent = 0xFFFFFFFFu;

  // Every edge has one or two triangles, every vertex one umbrella.
  [[nodiscard]] bool is_manifold() const {
    return non_manifold_edges == 0 && non_manifold_vertices == 0 && repeated_vertices == 0;
  }
  [[nodiscard]] bool is_oriented() const { return is_manifold() && misoriented_edges == 0; }
};

// The same for any number of threads.
MeshTopology mesh_topology(const MeshConnectivity& connectivity, int threads = 1);

// The first triangle that names a vertex out of range; mesh.triangles.size() when there is none.
std::size_t first_bad_triangle(const TriangleMesh& mesh);

}  // namespace deliso
