// The connected pieces of a mesh, and the exact components that their vertices lie on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// The number of the piece of each triangle: pieces are connected across sides, and numbered by their first triangles.
// Calls visit(triangles) for each in turn, with its triangles in no order. Precondition: the mesh has neighbours.
std::vector<std::uint32_t> number_pieces(const SurfaceMesh& mesh,
                                         const std::function<void(const std::vector<std::uint32_t>&)>& visit);

// Each vertex of some triangles once, ascending.
std::vector<std::uint32_t> vertices_of(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles);

// The component of a vertex that was moved off the isosurface.
inline constexpr std::uint32_t kNoComponent = 0xFFFFFFFFu;
// The exact component on which each of some vertices lies.
std::vector<std::uint32_t> components_at(const SurfaceMesh& mesh, std::span<const std::uint32_t> vertices,
                                         const ExactSurface& surface);

// The number of vertices of a piece that lie on a component.
struct ComponentShare {
  std::uint32_t piece = 0;
  std::uint32_t component = 0;
  std::int64_t vertices = 0;
};
// All nonzero shares, by piece and component. `piece_of` and `component_of` are per vertex: a number beyond `pieces`
// means no triangles, kNoComponent means no component.
std::vector<ComponentShare> component_shares(std::span<const std::uint32_t> piece_of,
                                             std::span<const std::uint32_t> component_of, std::size_t pieces);
// For each number below `count`: the largest of the shares with that number (the first of equals), or a share of no
// vertices if there is none. A piece is assigned to the component of its largest share.
template <class NumberOf>
std::vector<ComponentShare> largest_shares(std::span<const ComponentShare> shares, std::size_t count,
                                           const NumberOf& number_of) {
  std::vector<ComponentShare> largest(count);
  for (const ComponentShare& share : shares) {
    ComponentShare& so_far = largest[number_of(share)];
    if (share.vertices > so_far.vertices) so_far = share;
  }
  return largest;
}
inline std::vector<ComponentShare> largest_shares_of_pieces(std::span<const ComponentShare> shares,
                                                            std::size_t pieces) {
  return largest_shares(shares, pieces, [](const ComponentShare& share) { return share.piece; });
}
// The component of most vertices, the first of equals; nothing when no vertex has one.
std::optional<std::uint32_t> most_frequent(std::span<const std::uint32_t> component_of);

// The piece of each triangle, and the component of each piece: that of most of its vertices, kNoComponent where these
// lie on none.
struct PieceComponents {
  std::vector<std::uint32_t> piece_of, component;

  [[nodiscard]] std::uint32_t component_of(std::uint32_t triangle) const { return component[piece_of[triangle]]; }
};
// Precondition: the mesh has neighbours.
PieceComponents piece_components(const SurfaceMesh& mesh, const ExactSurface& surface);
// Removes the pieces on the components (or kNoComponent) for which is_gone(component) is true.
void drop_pieces(SurfaceMesh& mesh, const PieceComponents& pieces, const std::function<bool(std::uint32_t)>& is_gone);

}  // namespace deliso
