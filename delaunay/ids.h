// The element ids of a tetrahedralization.
#pragma once

#include "delaunay/base/strong_id.h"

namespace deliso {

using VertexId = StrongId<struct VertexTag>;
using TetId = StrongId<struct TetTag>;

// The vertex at infinity: the apex of every ghost tetrahedron. It has no point.
inline constexpr VertexId kInfiniteVertex{};

// One side of one tetrahedron, encoded as 4 * tetrahedron + face; face i lies opposite vertex slot i. The same facet
// seen from the neighbour is its mirror.
struct FacetId : StrongId<struct FacetTag> {
  constexpr FacetId() = default;
  constexpr explicit FacetId(std::uint32_t encoded) : StrongId(encoded) {}
  constexpr FacetId(TetId tet, unsigned face) : StrongId(4u * tet.value + face) {}
  [[nodiscard]] constexpr TetId tet() const { return TetId(value >> 2); }
  [[nodiscard]] constexpr unsigned face() const { return value & 3u; }
};

// Vertex slots of face i, counterclockwise seen from outside the tetrahedron.
inline constexpr unsigned kFacetSlots[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

}  // namespace deliso
