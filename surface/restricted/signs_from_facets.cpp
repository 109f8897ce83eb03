#include "surface/restricted/signs_from_facets.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

enum class Side : std::uint8_t { kUnknown, kBelow, kAbove };

// The side of the tetrahedron behind a facet, given the side of the one in front; nothing when the facet contradicts
// that side.
std::optional<Side> side_behind(const SignedDelaunay& restricted, FacetId f, Side side) {
  const bool falls = restricted.falls_through(f);
  const bool rises = restricted.falls_through(restricted.delaunay().mirror(f));
  if (!falls && !rises) return side;
  if (falls && rises) return std::nullopt;
  if (side != (falls ? Side::kAbove : Side::kBelow)) return std::nullopt;
  return falls ? Side::kBelow : Side::kAbove;
}

}  // namespace

std::optional<TetSigns> signs_from_facets(const SignedDelaunay& restricted) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  std::vector<Side> sides(delaunay.tet_slots(), Side::kUnknown);
  std::vector<TetId> waiting;
  const auto give = [&](TetId t, Side side) {
    sides[t.index()] = side;
    waiting.push_back(t);
  };

  // One restricted facet determines the side of its tetrahedron. Without restricted facets all tetrahedra have their
  // signs as sides.
  for (std::size_t i = 0; i < delaunay.tet_slots() && waiting.empty(); ++i) {
    for (unsigned face = 0; delaunay.is_live(TetId(i)) && face < 4 && waiting.empty(); ++face) {
      if (restricted.falls_through(FacetId(TetId(i), face))) give(TetId(i), Side::kAbove);
    }
  }
  if (waiting.empty()) return restricted.signs();

  // From there the sides propagate to all tetrahedra, and must agree wherever they meet.
  while (!waiting.empty()) {
    const TetId t = waiting.back();
    waiting.pop_back();
    for (unsigned face = 0; face < 4; ++face) {
      const std::optional<Side> behind = side_behind(restricted, FacetId(t, face), sides[t.index()]);
      const TetId neighbour = delaunay.neighbour(t, face);
      if (!behind) return std::nullopt;
      if (sides[neighbour.index()] == Side::kUnknown) give(neighbour, *behind);
      if (sides[neighbour.index()] != *behind) return std::nullopt;
    }
  }
  TetSigns above(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) above[i] = sides[i] == Side::kAbove ? 1 : 0;
  return above;
}

SurfaceMesh facets_alone(const SignedDelaunay& restricted, int threads) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  using Triangle = std::array<std::uint32_t, 3>;
  SurfaceMesh mesh;
  mesh.triangles =
      collect_in_blocks<Triangle>(delaunay.tet_slots(), threads, [&](std::size_t i, std::vector<Triangle>& triangles) {
        if (!delaunay.is_live(TetId(i))) return;
        for (unsigned face = 0; face < 4; ++face) {
          const FacetId f(TetId(i), face);
          if (!restricted.falls_through(f)) continue;
          const std::array<VertexId, 3> v = delaunay.facet_vertices(f);
          if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted.is_virtual(q); })) continue;
          triangles.push_back({v[0].value, v[1].value, v[2].value});
        }
      });
  std::vector<bool> is_used(delaunay.vertex_count(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t q : triangle) is_used[q] = true;
  }
  std::vector<std::uint32_t> name(is_used.size());
  for (std::size_t q = 0; q < is_used.size(); ++q) {
    name[q] = static_cast<std::uint32_t>(mesh.points.size());
    if (is_used[q]) mesh.points.push_back(delaunay.point(VertexId(q)));
  }
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& q : triangle) q = name[q];
  }
  return mesh;
}

}  // namespace deliso
