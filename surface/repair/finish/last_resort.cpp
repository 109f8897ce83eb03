#include "surface/repair/finish/last_resort.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "surface/certificate/finer_cubes.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/repair/finish/foreign_vertices.h"

namespace deliso {

namespace {

constexpr std::size_t kMostPairsAtLast = 4096;

// The triangles at which something is wrong.
std::vector<bool> faulty_triangles(const SurfaceMesh& mesh, const MeshFaults& faults) {
  std::vector<bool> is_faulty(mesh.triangles.size(), false), is_off(mesh.points.size(), false);
  for (const std::uint32_t v : faults.geometry.off_vertices) is_off[v] = true;
  for (const std::uint32_t v : faults.geometry.reversed_vertices) is_off[v] = true;
  for (const MeshEdge& edge : faults.geometry.off_box_edges) is_off[edge.low] = is_off[edge.high] = true;
  for (const std::uint32_t t : faults.geometry.far_triangles) is_faulty[t] = true;
  for (const TrianglePair& pair : faults.crossing.crossing) is_faulty[pair.first] = is_faulty[pair.second] = true;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (is_off[a] || is_off[b] || is_off[c]) is_faulty[t] = true;
  }
  return is_faulty;
}

// Adds the components that have faults.
void mark_faulty(SurfaceMesh& mesh, const ExactSurface& surface, const MeshFaults& faults,
                 std::vector<bool>& is_marked) {
  mesh.pole_heights.assign(mesh.points.size(), 1);
  set_side_adjacency(mesh);
  const PieceComponents pieces = piece_components(mesh, surface);
  const std::vector<bool> is_faulty = faulty_triangles(mesh, faults);
  for (std::uint32_t t = 0; t < is_faulty.size(); ++t) {
    const std::uint32_t component = pieces.component_of(t);
    if (is_faulty[t] && component != kNoComponent) is_marked[component] = true;
  }
  faults.places.mark(is_marked);
  for (const Vec3& p : faults.geometry.missed_points) {
    if (const auto component = surface.component_at(p)) is_marked[*component] = true;
  }
}

// What other pieces have of a component that they have swallowed would cross its cubes.
void take_foreign_vertices_out(const ExactSurface& surface, SurfaceMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.points.size());
  std::iota(all.begin(), all.end(), 0u);
  set_side_adjacency(mesh);
  remove_foreign_vertices(mesh, components_at(mesh, all, surface));
}

// Takes components from cubes of them. Returns how many.
std::int64_t replace_by(const ExactPolygonization& finer, const ExactSurface& surface,
                        const std::vector<bool>& is_marked, SurfaceMesh& mesh) {
  std::vector<bool> is_replaced(is_marked.size(), false);
  for (const std::uint32_t component : finer.component) is_replaced[component] = true;
  const std::int64_t count = std::count(is_replaced.begin(), is_replaced.end(), true);
  if (count == 0) return 0;
  drop_pieces(mesh, piece_components(mesh, surface),
              [&](std::uint32_t component) { return component != kNoComponent && is_replaced[component]; });
  append_pieces(finer.mesh, finer.component, is_replaced, mesh);
  take_foreign_vertices_out(surface, mesh);
  return count;
}

}  // namespace

SelfIntersections crossing_in_world(const SurfaceMesh& mesh, const Isosurface& isosurface, int threads) {
  return self_intersections(places_in_world(mesh, isosurface), mesh.triangles, kMostPairsAtLast, threads);
}

std::int64_t replace_faulty_components(SurfaceMesh& mesh, const ExactSurface& surface, const MeshFaults& faults,
                                       double cube, std::vector<bool>& is_marked) {
  is_marked.resize(surface.topology.components.size(), false);
  mark_faulty(mesh, surface, faults, is_marked);
  const GridFactors factors = factors_within(cube, surface.isosurface);
  return replace_by(finer_cubes(is_marked, surface, factors), surface, is_marked, mesh);
}

std::int64_t replace_by_nearer_cubes(SurfaceMesh& mesh, const ExactSurface& surface, const MeshFaults& faults,
                                     const CubeNearness& wanted, std::vector<bool>& is_marked) {
  is_marked.resize(surface.topology.components.size(), false);
  mark_faulty(mesh, surface, faults, is_marked);
  return replace_by(nearer_cubes(is_marked, surface, wanted), surface, is_marked, mesh);
}

}  // namespace deliso
