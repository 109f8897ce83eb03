#include "surface/crossing_pieces.h"

#include <algorithm>
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

// The component that most corners of some triangles lie on, the first of equals.
std::optional<std::uint32_t> component_of_piece(const SurfaceMesh& mesh, std::span<const std::uint32_t> piece,
                                                const SurfaceFacts& facts, const Isosurface& isosurface) {
  const Vec3& step = isosurface.step();
  std::map<std::uint32_t, std::size_t> votes;
  for (const std::uint32_t t : piece) {
    const Vec3& p = mesh.points[mesh.triangles[t][0]];
    const auto component =
        component_of(facts.grid(), isosurface.isovalue(), facts.topology(), {p.x / step.x, p.y / step.y, p.z / step.z});
    if (component) ++votes[*component];
  }
  if (votes.empty()) return std::nullopt;
  return std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

std::int64_t polygonize_crossing_pieces(SurfaceMesh& mesh, const SurfaceFacts& facts, const Isosurface& isosurface,
                                        std::vector<bool>& is_polygonized, int threads) {
  std::int64_t polygonized = 0;
  for (;;) {
    const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, kMostPairs, threads);
    std::vector<bool> is_seen(mesh.triangles.size(), false), is_gone(mesh.triangles.size(), false);
    std::vector<bool> wanted(is_polygonized.size(), false);
    for (const TrianglePair& pair : found.crossing) {
      for (const std::uint32_t seed : {pair.first, pair.second}) {
        if (is_seen[seed]) continue;
        const std::vector<std::uint32_t> piece = flood(mesh, seed, is_seen);
        const auto component = component_of_piece(mesh, piece, facts, isosurface);
        if (!component || is_polygonized[*component]) continue;
        wanted[*component] = is_polygonized[*component] = true;
        for (const std::uint32_t t : piece) is_gone[t] = true;
        ++polygonized;
      }
    }
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return polygonized;
    drop_triangles(mesh, is_gone);
    append_pieces(facts.polygonized().mesh, facts.polygonized().component, wanted, mesh);
  }
}

}  // namespace deliso
