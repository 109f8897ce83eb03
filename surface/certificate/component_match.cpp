#include "surface/certificate/component_match.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "surface/certificate/mesh_pieces.h"

namespace deliso {

namespace {

// Counts the boundary loops of each piece: on a manifold exactly one boundary edge leaves every boundary vertex, so
// loops are cycles.
void count_loops(const SurfaceMesh& mesh, ComponentMatch& match) {
  const auto is_open = [](const auto& sides) { return std::find(sides.begin(), sides.end(), kNoSide) != sides.end(); };
  if (std::none_of(mesh.neighbours.begin(), mesh.neighbours.end(), is_open)) return;
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

void find_components(const std::vector<std::uint32_t>& component_of, ComponentMatch& match) {
  const std::vector<ComponentShare> shares = component_shares(match.piece_of, component_of, match.pieces.size());
  const std::vector<ComponentShare> largest = largest_shares_of_pieces(shares, match.pieces.size());
  for (std::size_t i = 0; i < match.pieces.size(); ++i) {
    match.pieces[i].component = largest[i].vertices > 0 ? largest[i].component : kNoComponent;
  }
  for (const ComponentShare& share : shares) {
    if (share.component != match.pieces[share.piece].component) match.pieces[share.piece].mixed = true;
  }
}

void find_agreements(const std::vector<ComponentTopology>& components, const std::vector<std::uint32_t>& component_of,
                     ComponentMatch& match) {
  match.main_piece.assign(components.size(), kNoPiece);
  match.agreement.assign(components.size(), Agreement::kNone);
  std::vector<bool> is_mixed(components.size(), false);
  for (std::size_t v = 0; v < component_of.size(); ++v) {
    if (component_of[v] == kNoComponent || match.piece_of[v] == kNoPiece) continue;
    if (match.pieces[match.piece_of[v]].mixed) is_mixed[component_of[v]] = true;
  }
  std::vector<std::int64_t> pieces_on(components.size(), 0);
  for (std::uint32_t i = 0; i < match.pieces.size(); ++i) {
    const MeshPiece& piece = match.pieces[i];
    if (piece.component == kNoComponent) {
      ++match.error;
      continue;
    }
    std::uint32_t& main = match.main_piece[piece.component];
    if (main == kNoPiece || piece.vertices > match.pieces[main].vertices) main = i;
    ++pieces_on[piece.component];
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    const std::uint32_t main = match.main_piece[c];
    ComponentTopology topology;
    if (main != kNoPiece) topology = match.pieces[main].topology;
    if (main != kNoPiece && topology == components[c]) {
      match.agreement[c] = is_mixed[c]        ? Agreement::kMixed
                           : pieces_on[c] > 1 ? Agreement::kWithStrays
                                              : Agreement::kExact;
    }
    if (match.agreement[c] == Agreement::kExact) continue;
    match.error += 1 + std::max<std::int64_t>(0, pieces_on[c] - 1);
    match.error += std::abs(topology.euler_characteristic - components[c].euler_characteristic);
  }
}

}  // namespace

ComponentMatch find_pieces(const SurfaceMesh& mesh) {
  ComponentMatch match;
  const std::vector<std::uint32_t> piece_of_triangle =
      number_pieces(mesh, [&](const auto&) { match.pieces.emplace_back(); });
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
      ++piece.vertices;
      ++piece.topology.euler_characteristic;
    }
  }
  count_loops(mesh, match);
  return match;
}

ComponentMatch match_components(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                const std::vector<ComponentTopology>& components) {
  ComponentMatch match = find_pieces(mesh);
  find_components(component_of, match);
  find_agreements(components, component_of, match);
  return match;
}

}  // namespace deliso
