#include "surface/component_match.h"

#include <cstdlib>

namespace deliso {

namespace {

constexpr std::uint32_t kNoPiece = 0xFFFFFFFFu;

// Labels the pieces by flooding over neighbours; returns how many.
std::uint32_t label_triangles(const SurfaceMesh& mesh, std::vector<std::uint32_t>& piece_of_triangle) {
  piece_of_triangle.assign(mesh.triangles.size(), kNoPiece);
  std::vector<std::uint32_t> stack;
  std::uint32_t pieces = 0;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (piece_of_triangle[seed] != kNoPiece) continue;
    piece_of_triangle[seed] = pieces;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (const TriangleSide side : mesh.neighbours[t]) {
        if (side == kNoSide || piece_of_triangle[side >> 2] != kNoPiece) continue;
        piece_of_triangle[side >> 2] = pieces;
        stack.push_back(side >> 2);
      }
    }
    ++pieces;
  }
  return pieces;
}

// Boundary loops of each piece: on a manifold every boundary vertex is left by one boundary edge, so loops are cycles.
void count_loops(const SurfaceMesh& mesh, ComponentMatch& match) {
  std::vector<std::uint32_t> next(mesh.points.size(), kNoPiece);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.neighbours[t][i] != kNoSide) continue;
      next[mesh.triangles[t][(i + 1) % 3]] = mesh.triangles[t][(i + 2) % 3];
    }
  }
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNoPiece) continue;
    ++match.pieces[match.piece_of[start]].topology.boundary_loops;
    for (std::uint32_t v = start; next[v] != kNoPiece;) {
      const std::uint32_t after = next[v];
      next[v] = kNoPiece;
      v = after;
    }
  }
}

}  // namespace

ComponentMatch match_components(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                const std::vector<ComponentTopology>& components) {
  ComponentMatch match;
  std::vector<std::uint32_t> piece_of_triangle;
  match.pieces.resize(label_triangles(mesh, piece_of_triangle));
  match.piece_of.assign(mesh.points.size(), kNoPiece);

  // Euler characteristic: vertices - edges + triangles; an edge with two triangles is counted from the larger side.
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    MeshPiece& piece = match.pieces[piece_of_triangle[t]];
    ++piece.topology.euler_characteristic;
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide across = mesh.neighbours[t][i];
      if (across == kNoSide || across < 4 * t + i) --piece.topology.euler_characteristic;
      const std::uint32_t v = mesh.triangles[t][i];
      if (match.piece_of[v] != kNoPiece) continue;
      match.piece_of[v] = piece_of_triangle[t];
      ++piece.topology.euler_characteristic;
    }
  }
  count_loops(mesh, match);

  // Which components each piece touches.
  std::vector<bool> has_vertex(match.pieces.size(), false);
  std::vector<std::int64_t> pieces_on(components.size(), 0);
  std::vector<std::int64_t> chi_on(components.size(), 0);
  std::vector<bool> touched_by_mixed(components.size(), false);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (match.piece_of[v] == kNoPiece) continue;
    MeshPiece& piece = match.pieces[match.piece_of[v]];
    if (!has_vertex[match.piece_of[v]]) {
      has_vertex[match.piece_of[v]] = true;
      piece.component = component_of[v];
    }
    piece.mixed |= piece.component != component_of[v];
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (match.piece_of[v] != kNoPiece && match.pieces[match.piece_of[v]].mixed)
      touched_by_mixed[component_of[v]] = true;
  }
  for (const MeshPiece& piece : match.pieces) {
    ++pieces_on[piece.component];
    chi_on[piece.component] += piece.topology.euler_characteristic;
  }

  match.component_matched.assign(components.size(), false);
  for (MeshPiece& piece : match.pieces) {
    piece.matched = pieces_on[piece.component] == 1 && !touched_by_mixed[piece.component] &&
                    piece.topology == components[piece.component];
    if (piece.matched) match.component_matched[piece.component] = true;
    match.unmatched_pieces += piece.matched ? 0 : 1;
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (match.component_matched[c]) continue;
    ++match.unmatched_components;
    match.characteristic_error += std::abs(chi_on[c] - components[c].euler_characteristic);
  }
  return match;
}

}  // namespace deliso
