// The restricted facets of a signed triangulation and how they are paired across their edges.
//
// The restricted facets bound the tetrahedra above the isovalue, so around every edge their number is even. If it is
// more than two, the surface touches itself there. The facets then bound sectors of tetrahedra of equal sign around the
// edge. Facets are paired around the sectors whose sign is not that of the field at the edge's midpoint. So the side
// that holds the midpoint stays connected.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/parallel_blocks.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// A restricted facet without virtual vertices, seen from the tetrahedron above. Side i lies opposite vertices[i].
struct PairedFacet {
  FacetId facet;
  std::array<VertexId, 3> vertices;  // counterclockwise seen from below
  // The paired side, of the facet at that index in facets(); kNoSide if that facet is virtual.
  std::array<TriangleSide, 3> across;
  std::array<bool, 3> contested;  // whether the edge has more than two restricted facets
  std::array<bool, 3> known;      // whether the entries of `across` and `contested` are valid
};

// The facet of a tetrahedron opposite one of its vertices: the next facet of a walk around an edge.
inline FacetId facet_opposite(const Tetrahedralization& delaunay, TetId t, VertexId vertex) {
  const auto& v = delaunay.vertices(t);
  return {t, v[0] == vertex ? 0u : v[1] == vertex ? 1u : v[2] == vertex ? 2u : 3u};
}

// The paired facets as a mesh whose vertices are not made yet (build_triangle_mesh.h).
struct PairedTriangles {
  std::vector<FacetId> facets;                          // of each triangle, ascending
  std::vector<std::array<std::uint32_t, 3>> triangles;  // vertices of the triangulation, as in PairedFacet
  std::vector<std::array<TriangleSide, 3>> neighbours;  // across each side
  // Sides whose edge has more than two restricted facets, ascending.
  std::vector<TriangleSide> contested;
  std::vector<bool> is_split;  // of each vertex: its triangles form more than one fan
};

// The partner of a restricted facet across its edge opposite `third`; both are seen from the tetrahedron above.
struct PairingAcross {
  FacetId partner;
  bool is_contested = false;  // the edge has more than two restricted facets
};
PairingAcross paired_across(const SignedDelaunay& restricted, FacetId facet, VertexId third);

class FacetPairing {
 public:
  // Keeps a reference to the triangulation, and a copy of the signs: those of the triangulation may change
  // independently. The same for any number of threads.
  explicit FacetPairing(const SignedDelaunay& restricted, int threads = 1)
      : FacetPairing(restricted, restricted.signs(), threads) {}
  FacetPairing(const SignedDelaunay& restricted, TetSigns signs, int threads);

  // Brings the pairing up to date with the present signs: only the facets at the vertices of tetrahedra whose sign has
  // changed are paired anew. Returns whether any sign has changed.
  bool update() { return update(restricted_.signs()); }
  bool update(const TetSigns& signs);
  // Brings the arrays up to date after an exchange of points; call update() afterwards.
  void renew(const ExchangedPoints& exchanged);

  [[nodiscard]] const SignedDelaunay& restricted() const { return restricted_; }
  [[nodiscard]] std::span<const PairedFacet> facets() const { return facets_; }  // in order
  [[nodiscard]] PairedTriangles triangles() const;
  // The index of a facet in facets(); kNoPlace for one that is not there.
  [[nodiscard]] std::uint32_t place_of(FacetId f) const {
    std::uint32_t place = first_of_[f.tet().index()];
    while (place < facets_.size() && facets_[place].facet < f) ++place;
    return place < facets_.size() && facets_[place].facet == f ? place : kNoPlace;
  }
  static constexpr std::uint32_t kNoPlace = 0xFFFFFFFFu;

 private:
  [[nodiscard]] bool is_above(TetId t) const { return signs_[t.index()] != 0; }
  void touch(TetId t);
  void append_facets_of(TetId t, std::vector<PairedFacet>& facets) const;
  void find_places();
  void renew_facets(std::span<const TetId> tets);
  void forget_sides_between(const std::vector<bool>& has_changed);
  void find_split_vertices(const std::vector<bool>& has_changed, int threads);
  void pair_uncontested_sides(int threads);
  void pair_sides(int threads);
  // The facets paired by one thread.
  struct Share {
    std::size_t first = 0, last = 0;
  };
  template <class Visit>
  void for_each_unknown_side(const Shares& shares, int threads, Visit&& visit);
  std::uint32_t join(PairedFacet& facet, unsigned side, const PairingAcross& across, const Share& share);
  [[nodiscard]] std::uint32_t number_of(const PairedFacet& facet) const {
    return static_cast<std::uint32_t>(&facet - facets_.data());
  }
  [[nodiscard]] TriangleSide side_across(const PairedFacet& facet, unsigned side, std::uint32_t place) const;

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  TetSigns signs_;  // as of the last update
  // What renew() leaves for update(): tetrahedra that are new, gone, or next to such ones; and the vertices of the new
  // ones.
  std::vector<TetId> touched_;
  std::vector<VertexId> touched_vertices_;
  std::vector<PairedFacet> facets_;
  std::vector<PairedFacet> spare_;      // memory reused by the next update
  std::vector<bool> is_split_;          // of each vertex: its facets form more than one fan
  LargeArray<std::uint32_t> first_of_;  // of each tetrahedron: the index of its first facet, or kNoPlace
};

}  // namespace deliso
