#include "surface/repair/finish/marching_cubes_fallback.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "surface/certificate/component_assignment.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/intersection/self_intersection.h"

namespace deliso {

namespace {

// The largest number of pairs whose pieces are examined in one pass.
constexpr std::size_t kMostPairs = 4096;

// Drops the pieces of the pairs whose components are not polygonized yet; marks these components, and returns them.
std::vector<bool> drop_pieces(std::span<const TrianglePair> pairs, SurfaceMesh& mesh, const ExactSurface& surface,
                              std::vector<bool>& is_polygonized) {
  std::vector<bool> is_seen(mesh.triangles.size(), false), is_gone(mesh.triangles.size(), false);
  std::vector<bool> dropped(is_polygonized.size(), false);
  for (const TrianglePair& pair : pairs) {
    for (const std::uint32_t seed : {pair.first, pair.second}) {
      if (is_seen[seed]) continue;
      const std::vector<std::uint32_t> piece = flood(mesh, seed, is_seen);
      const auto component = most_frequent(components_at(mesh, vertices_of(mesh, piece), surface));
      if (!component || is_polygonized[*component]) continue;
      dropped[*component] = is_polygonized[*component] = true;
      for (const std::uint32_t t : piece) is_gone[t] = true;
    }
  }
  drop_triangles(mesh, is_gone);
  return dropped;
}

// Drops the pieces assigned to one of these components, or to none at all.
void drop_pieces_of(const std::vector<bool>& components, SurfaceMesh& mesh, const ExactSurface& surface) {
  std::vector<bool> is_seen(mesh.triangles.size(), false), is_gone(mesh.triangles.size(), false);
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (is_seen[seed]) continue;
    const std::vector<std::uint32_t> piece = flood(mesh, seed, is_seen);
    const auto component = most_frequent(components_at(mesh, vertices_of(mesh, piece), surface));
    if (component && !components[*component]) continue;
    for (const std::uint32_t t : piece) is_gone[t] = true;
  }
  drop_triangles(mesh, is_gone);
}

}  // namespace

bool polygonize_misplaced_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache, std::vector<bool>& is_polygonized) {
  const AssignmentFaults faults = assignment_faults(mesh, cache.surface());
  if (faults.is_empty()) return false;
  std::vector<bool> replaced(is_polygonized.size(), false);
  for (const auto* components : {&faults.without, &faults.repeated, &faults.unlike, &faults.overrunning}) {
    for (const std::uint32_t c : *components) replaced[c] = is_polygonized[c] = true;
  }
  drop_pieces_of(replaced, mesh, cache.surface());
  const ExactPolygonization& cubes = cache.polygonized();
  append_pieces(cubes.mesh, cubes.component, replaced, mesh);
  return true;
}

void polygonize_crossing_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache, std::vector<bool>& is_polygonized,
                                Controls& controls) {
  while (!controls.poll()) {
    const SelfIntersections found =
        self_intersections(mesh.points, mesh.triangles, kMostPairs, cache.surface().threads);
    if (found.crossing_pairs == 0) return;
    const ExactPolygonization& cubes = cache.polygonized();
    const std::vector<bool> dropped = drop_pieces(found.crossing, mesh, cache.surface(), is_polygonized);
    if (std::find(dropped.begin(), dropped.end(), true) == dropped.end()) {
      // No further piece can be blamed. Inverted umbrellas may have been removed from pieces of marching cubes, so even
      // these may cross: take all components from marching cubes anew.
      is_polygonized.assign(is_polygonized.size(), true);
      mesh = cubes.mesh;
      return;
    }
    append_pieces(cubes.mesh, cubes.component, dropped, mesh);
  }
}

}  // namespace deliso
