// The umbrella D_q of a vertex: its restricted facets, and whether they form a topological disk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/restricted/link_change.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

enum class UmbrellaShape {
  kEmpty,     // no restricted facet at all
  kDisk,      // one closed fan
  kHalfDisk,  // one fan that closes through the infinite vertex: the vertex lies on the surface's boundary
  kBroken,    // anything else
};

// The shape of an umbrella of `size` restricted facets, by a walk from facet to facet. `first` is one of them, seen
// from the tetrahedron above the isovalue. Much faster than a search of the whole star, but kBroken may also mean that
// the walk gave up.
UmbrellaShape shape_by_walk(const SignedDelaunay& restricted, VertexId q, FacetId first, std::uint32_t size);

// Walks stars. Holds scratch memory; one object serves any number of vertices of one triangulation.
class UmbrellaInspector {
 public:
  explicit UmbrellaInspector(const SignedDelaunay& restricted) : restricted_(restricted) {}

  UmbrellaShape inspect(VertexId q);

  // Of the vertex inspected last: its restricted facets, including those with a virtual vertex, each seen from the
  // tetrahedron above the isovalue; and the tetrahedra around the vertex.
  [[nodiscard]] std::span<const FacetId> facets() const { return facets_; }
  [[nodiscard]] std::span<const TetId> star() const { return star_; }

 private:
  void collect(VertexId q);

  const SignedDelaunay& restricted_;
  std::vector<std::uint32_t> seen_;  // of each tetrahedron: the last inspection that visited it
  std::uint32_t inspection_ = 0;
  std::vector<TetId> star_;
  std::vector<FacetId> facets_;
  std::vector<LinkEdge> link_;  // of facets_[i]: the edge opposite q, counterclockwise seen from below the isovalue
};

}  // namespace deliso
