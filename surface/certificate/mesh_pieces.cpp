#include "surface/certificate/mesh_pieces.h"

#include <algorithm>
#include <utility>

namespace deliso {

namespace {

// For fewer triangles than one per so many vertices of the mesh, their vertices are sorted instead of marked.
constexpr std::size_t kFewTriangles = 64;

}  // namespace

std::vector<std::uint32_t> number_pieces(const SurfaceMesh& mesh,
                                         const std::function<void(const std::vector<std::uint32_t>&)>& visit) {
  constexpr std::uint32_t kUnseen = 0xFFFFFFFFu;
  std::vector<std::uint32_t> piece_of(mesh.triangles.size(), kUnseen);
  std::vector<std::uint32_t> piece;
  std::uint32_t number = 0;
  for (std::uint32_t seed = 0; seed < piece_of.size(); ++seed) {
    if (piece_of[seed] != kUnseen) continue;
    piece.assign(1, seed);
    piece_of[seed] = number;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (const TriangleSide side : mesh.neighbours[piece[i]]) {
        if (side == kNoSide || piece_of[side >> 2] != kUnseen) continue;
        piece_of[side >> 2] = number;
        piece.push_back(side >> 2);
      }
    }
    visit(piece);
    ++number;
  }
  return piece_of;
}

std::vector<std::uint32_t> vertices_of(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> vertices;
  if (triangles.size() > mesh.points.size() / kFewTriangles) {
    std::vector<bool> is_met(mesh.points.size(), false);
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t v : mesh.triangles[t]) is_met[v] = true;
    }
    for (std::uint32_t v = 0; v < is_met.size(); ++v) {
      if (is_met[v]) vertices.push_back(v);
    }
    return vertices;
  }
  vertices.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles) {
    vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<std::uint32_t> components_at(const SurfaceMesh& mesh, std::span<const std::uint32_t> vertices,
                                         const ExactSurface& surface) {
  std::vector<std::uint32_t> components;
  components.reserve(vertices.size());
  for (const std::uint32_t v : vertices) {
    components.push_back(surface.component_at(mesh.points[v]).value_or(kNoComponent));
  }
  return components;
}

std::vector<ComponentShare> component_shares(std::span<const std::uint32_t> piece_of,
                                             std::span<const std::uint32_t> component_of, std::size_t pieces) {
  // Nearly all vertices of a piece lie on the component of its first one. Only the others are sorted.
  std::vector<ComponentShare> shares(pieces);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others;  // (piece, component)
  for (std::size_t v = 0; v < piece_of.size(); ++v) {
    const std::uint32_t piece = piece_of[v], component = component_of[v];
    if (piece >= pieces || component == kNoComponent) continue;
    ComponentShare& first = shares[piece];
    if (first.vertices == 0) first = {piece, component, 0};
    if (component == first.component) {
      ++first.vertices;
    } else {
      others.emplace_back(piece, component);
    }
  }
  std::erase_if(shares, [](const ComponentShare& share) { return share.vertices == 0; });
  std::sort(others.begin(), others.end());
  for (auto first = others.begin(); first != others.end();) {
    const auto last = std::upper_bound(first, others.end(), *first);
    shares.push_back({first->first, first->second, last - first});
    first = last;
  }
  std::sort(shares.begin(), shares.end(), [](const ComponentShare& a, const ComponentShare& b) {
    return std::pair(a.piece, a.component) < std::pair(b.piece, b.component);
  });
  return shares;
}

std::optional<std::uint32_t> most_frequent(std::span<const std::uint32_t> component_of) {
  const std::vector<std::uint32_t> piece_of(component_of.size(), 0);
  const ComponentShare largest = largest_shares_of_pieces(component_shares(piece_of, component_of, 1), 1).front();
  if (largest.vertices == 0) return std::nullopt;
  return largest.component;
}

PieceComponents piece_components(const SurfaceMesh& mesh, const ExactSurface& surface) {
  PieceComponents pieces;
  pieces.piece_of = number_pieces(mesh, [&](const std::vector<std::uint32_t>& piece) {
    const auto component = most_frequent(components_at(mesh, vertices_of(mesh, piece), surface));
    pieces.component.push_back(component.value_or(kNoComponent));
  });
  return pieces;
}

void drop_pieces(SurfaceMesh& mesh, const PieceComponents& pieces, const std::function<bool(std::uint32_t)>& is_gone) {
  std::vector<bool> is_dropped(mesh.triangles.size(), false);
  for (std::uint32_t t = 0; t < is_dropped.size(); ++t) is_dropped[t] = is_gone(pieces.component_of(t));
  drop_triangles(mesh, is_dropped);
}

}  // namespace deliso
