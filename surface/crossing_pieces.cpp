#include "surface/crossing_pieces.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "surface/self_intersection.h"

namespace deliso {

namespace {

// Of so many pairs the pieces are looked at together.
constexpr std::size_t kMostPairs = 4096;

// Marks all triangles of the piece of one; returns them.
std::vector<std::uint32_t> flood(const SurfaceMesh& mesh, std::uint32_t seed, std::vector<bool>& is_marked) {
  std::vector<std::uint32_t> piece = {seed};
  is_marked[seed] = true;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    for (const TriangleSide side : mesh.neighbours[piece[i]]) {
      if (side == kNoSide || is_marked[side >> 2]) continue;
      is_marked[side >> 2] = true;
      piece.push_back(side >> 2);
    }
  }
  return piece;
}

// The component that most vertices of a piece lie on, the first of equals.
std::optional<std::uint32_t> component_of_piece(const SurfaceMesh& mesh, std::span<const std::uint32_t> piece,
                                                const SurfaceFacts& facts, const Isosurface& isosurface) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : piece) {
    vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const Vec3& step = isosurface.step();
  std::map<std::uint32_t, std::size_t> votes;
  for (const std::uint32_t v : vertices) {
    const Vec3& p = mesh.points[v];
    const auto component =
        component_of(facts.grid(), isosurface.isovalue(), facts.topology(), {p.x / step.x, p.y / step.y, p.z / step.z});
    if (component) ++votes[*component];
  }
  if (votes.empty()) return std::nullopt;
  return std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

// Drops the pieces of the pairs whose components are not polygonized yet; these are marked and returned.
std::vector<bool> drop_pieces(std::span<const TrianglePair> pairs, SurfaceMesh& mesh, const SurfaceFacts& facts,
                              const Isosurface& isosurface, std::vector<bool>& is_polygonized) {
  std::vector<bool> is_seen(mesh.triangles.size(), false), is_gone(mesh.triangles.size(), false);
  std::vector<bool> dropped(is_polygonized.size(), false);
  for (const TrianglePair& pair : pairs) {
    for (const std::uint32_t seed : {pair.first, pair.second}) {
      if (is_seen[seed]) continue;
      const std::vector<std::uint32_t> piece = flood(mesh, seed, is_seen);
      const auto component = component_of_piece(mesh, piece, facts, isosurface);
      if (!component || is_polygonized[*component]) continue;
      dropped[*component] = is_polygonized[*component] = true;
      for (const std::uint32_t t : piece) is_gone[t] = true;
    }
  }
  drop_triangles(mesh, is_gone);
  return dropped;
}

}  // namespace

void polygonize_crossing_pieces(SurfaceMesh& mesh, const SurfaceFacts& facts, const Isosurface& isosurface,
                                std::vector<bool>& is_polygonized, int threads, Controls& controls) {
  while (!controls.poll()) {
    const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, kMostPairs, threads);
    if (found.crossing_pairs == 0) return;
    const PolygonizedSurface& cubes = facts.polygonized();
    const std::vector<bool> dropped = drop_pieces(found.crossing, mesh, facts, isosurface, is_polygonized);
    if (std::find(dropped.begin(), dropped.end(), true) == dropped.end()) {
      // Nothing more can be told apart; dents may have been removed from what there is of marching cubes.
      is_polygonized.assign(is_polygonized.size(), true);
      mesh = cubes.mesh;
      return;
    }
    append_pieces(cubes.mesh, cubes.component, dropped, mesh);
  }
}

}  // namespace deliso
