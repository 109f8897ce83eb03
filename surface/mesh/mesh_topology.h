// Which triangles meet at the edges and vertices of a mesh: the counts behind every combinatorial check.
//
// A half-edge runs along a triangle from one corner to the next. Half-edges with the same two end vertices, whatever
// their directions, form an edge. Nothing is assumed of the mesh: an edge may have any number of half-edges, triangles
// may repeat a vertex (such an edge has low == high) or each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

struct MeshEdge {
  std::uint32_t low = 0;   // vertex with the smaller index
  std::uint32_t high = 0;  // vertex with the larger index
  friend bool operator==(const MeshEdge& a, const MeshEdge& b) = default;
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
  std::vector<MeshEdge> boundary_edges;    // edges with one triangle, in lexicographic order
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

// In linear time for meshes of bounded valence; takes about 60 bytes per vertex of a closed mesh. The same for any
// number of threads. Precondition: every index is below mesh.points.size() (see first_bad_triangle).
MeshTopology mesh_topology(const TriangleMesh& mesh, int threads = 1);
MeshTopology mesh_topology(std::size_t vertices, std::span<const std::array<std::uint32_t, 3>> triangles, int threads);

// The first triangle that names a vertex out of range; mesh.triangles.size() when there is none.
std::size_t first_bad_triangle(const TriangleMesh& mesh);
// Throws InputError when there is one.
void check_triangles(const TriangleMesh& mesh);

}  // namespace deliso
