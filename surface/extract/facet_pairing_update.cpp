// FacetPairing: the update after signs have changed or points were exchanged.
#include <algorithm>
#include <utility>

#include "surface/extract/facet_pairing.h"

namespace deliso {

// A facet may appear or vanish at a tetrahedron that is new or has changed its sign, and at its neighbours.
void FacetPairing::touch(TetId t) {
  touched_.push_back(t);
  if (!delaunay_.is_live(t)) return;
  for (unsigned face = 0; face < 4; ++face) touched_.push_back(delaunay_.neighbour(t, face));
  for (const VertexId v : delaunay_.vertices(t)) {
    if (v != kInfiniteVertex) touched_vertices_.push_back(v);
  }
}

void FacetPairing::renew(const ExchangedPoints& exchanged) {
  signs_.resize(delaunay_.tet_slots(), 0);
  for (PairedFacet& facet : facets_) {
    for (VertexId& v : facet.vertices) v = exchanged.renamed[v.index()];  // none only if the facet is gone
  }
  std::size_t kept = 0;
  for (std::size_t v = 0; v < exchanged.renamed.size(); ++v) {
    if (!exchanged.renamed[v].is_none()) is_split_[kept++] = is_split_[v];
  }
  is_split_.resize(kept);
  is_split_.resize(delaunay_.vertex_count(), false);
  // The remaining vertices of a destroyed tetrahedron are vertices of new ones.
  for (const TetId t : exchanged.renewed) {
    signs_[t.index()] = restricted_.is_above(t) ? 1 : 0;
    touch(t);
  }
}

bool FacetPairing::update(const TetSigns& signs) {
  for_each_difference(signs_, signs, [&](TetId t) {
    signs_[t.index()] = signs[t.index()];
    touch(t);
  });
  if (touched_.empty()) return false;
  std::vector<bool> is_touched(delaunay_.tet_slots(), false);
  for (const TetId t : touched_) is_touched[t.index()] = true;
  touched_.clear();
  for (std::size_t i = 0; i < is_touched.size(); ++i) {
    if (is_touched[i]) touched_.emplace_back(i);
  }
  renew_facets(touched_);
  // Of each vertex: whether a tetrahedron at it has changed.
  std::vector<bool> has_changed(delaunay_.vertex_count(), false);
  for (const VertexId v : touched_vertices_) has_changed[v.index()] = true;
  touched_.clear();
  touched_vertices_.clear();
  forget_sides_between(has_changed);
  constexpr int kThread = 1;  // few sides are left to pair
  pair_sides(kThread);
  find_split_vertices(has_changed, kThread);
  return true;
}

// Every tetrahedron around an edge has both ends as vertices.
void FacetPairing::forget_sides_between(const std::vector<bool>& has_changed) {
  for (PairedFacet& facet : facets_) {
    std::array<bool, 3> changed{};
    for (unsigned i = 0; i < 3; ++i) changed[i] = has_changed[facet.vertices[i].index()];
    for (unsigned i = 0; i < 3; ++i) facet.known[i] = facet.known[i] && !(changed[(i + 1) % 3] && changed[(i + 2) % 3]);
  }
}

// Computes the facets of some tetrahedra (ascending) anew and keeps the others.
void FacetPairing::renew_facets(std::span<const TetId> tets) {
  std::vector<PairedFacet> facets = std::move(spare_);
  facets.clear();
  facets.reserve(facets_.size() + tets.size());
  std::vector<std::uint32_t> place(facets_.size(), kNoPlace);  // of each old facet that stays: its new index
  std::uint32_t old = 0;
  const auto keep_those_before = [&](TetId t) {
    for (; old < facets_.size() && facets_[old].facet.tet() < t; ++old) {
      place[old] = static_cast<std::uint32_t>(facets.size());
      facets.push_back(facets_[old]);
    }
  };
  for (const TetId t : tets) {
    keep_those_before(t);
    while (old < facets_.size() && facets_[old].facet.tet() == t) ++old;
    append_facets_of(t, facets);
  }
  keep_those_before(TetId(delaunay_.tet_slots()));
  // A side that was paired with a facet that is gone or new will be paired again.
  for (PairedFacet& facet : facets) {
    for (unsigned side = 0; side < 3; ++side) {
      TriangleSide& across = facet.across[side];
      if (!facet.known[side] || across == kNoSide) continue;
      const std::uint32_t there = place[across >> 2];
      across = there == kNoPlace ? kNoSide : 4 * there + (across & 3u);
    }
  }
  spare_ = std::exchange(facets_, std::move(facets));
  find_places();
}

}  // namespace deliso
