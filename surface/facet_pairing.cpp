#include "surface/facet_pairing.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

// Counts of ways around edges, per facet; a facet has one edge and a half.
constexpr std::size_t kCountsPerFacet = 8;

// From a restricted facet, rotate about its edge opposite `third` through the tetrahedra of one sign, f's own, to the
// next restricted facet; both are seen from inside that sector.
FacetId next_restricted_facet(const SignedDelaunay& restricted, FacetId f, VertexId third) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const bool is_above = restricted.is_above(f.tet());
  for (;;) {
    const auto& v = delaunay.vertices(f.tet());
    const FacetId g(f.tet(), v[0] == third ? 0u : v[1] == third ? 1u : v[2] == third ? 2u : 3u);
    const FacetId beyond = delaunay.mirror(g);
    if (restricted.is_above(beyond.tet()) != is_above) return g;
    third = v[f.face()];
    f = beyond;
  }
}

}  // namespace

PairingAcross paired_across(const SignedDelaunay& restricted, FacetId facet, VertexId third) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const FacetId around_above = next_restricted_facet(restricted, facet, third);
  const FacetId around_below = delaunay.mirror(next_restricted_facet(restricted, delaunay.mirror(facet), third));
  if (around_above == around_below) return {around_above, false};
  // The other two vertices are the ends of the edge.
  Vec3 sum;
  for (const VertexId v : delaunay.facet_vertices(facet)) {
    if (v != third) sum += delaunay.point(v);
  }
  return {restricted.isosurface().is_above(0.5 * sum) ? around_below : around_above, true};
}

FacetPairing::FacetPairing(const SignedDelaunay& restricted)
    : restricted_(restricted), delaunay_(restricted.delaunay()), signs_(delaunay_.tet_slots(), 0) {
  restricted_.for_each_change(signs_, [](TetId) {});
  place_of_.assign(4 * delaunay_.tet_slots(), kNoPlace);
  for (std::size_t i = 0; i < delaunay_.tet_slots(); ++i) append_facets_of(TetId(i), facets_);
  for (std::uint32_t i = 0; i < facets_.size(); ++i) place_of_[facets_[i].facet.index()] = i;
  // Guards may share an edge with two facets that are not ours.
  if (!restricted_.is_virtual(VertexId(delaunay_.vertex_count() - 1))) pair_uncontested_sides();
  pair_sides();
}

// A facet may come or go at a tetrahedron that has another sign or is new, and at its neighbours.
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
  place_of_.resize(4 * delaunay_.tet_slots(), kNoPlace);
  for (PairedFacet& facet : facets_) {
    for (VertexId& v : facet.vertices) v = exchanged.renamed[v.index()];  // none only where the facet has gone
  }
  // The vertices of a tetrahedron that has gone are those of new ones, if they are left.
  for (const TetId t : exchanged.renewed) {
    signs_[t.index()] = restricted_.is_above(t) ? 1 : 0;
    touch(t);
  }
}

bool FacetPairing::update() {
  restricted_.for_each_change(signs_, [&](TetId t) { touch(t); });
  if (touched_.empty()) return false;
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  renew_facets(touched_);
  std::vector<bool> has_changed(delaunay_.vertex_count(), false);  // of each vertex: the sign of a tetrahedron at it
  for (const VertexId v : touched_vertices_) has_changed[v.index()] = true;
  touched_.clear();
  touched_vertices_.clear();

  // The tetrahedra around an edge are at both its ends.
  for (PairedFacet& facet : facets_) {
    std::array<bool, 3> changed{};
    for (unsigned i = 0; i < 3; ++i) changed[i] = has_changed[facet.vertices[i].index()];
    for (unsigned i = 0; i < 3; ++i) facet.known[i] = facet.known[i] && !(changed[(i + 1) % 3] && changed[(i + 2) % 3]);
  }
  pair_sides();
  return true;
}

void FacetPairing::append_facets_of(TetId t, std::vector<PairedFacet>& facets) const {
  if (!delaunay_.is_live(t) || !restricted_.is_above(t)) return;
  for (unsigned face = 0; face < 4; ++face) {
    const FacetId f(t, face);
    if (!restricted_.is_restricted(f)) continue;
    const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
    if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted_.is_virtual(q); })) continue;
    facets.push_back({f, v, {}, {}, {}});
  }
}

// The facets of some tetrahedra (ascending) anew, the others as they are.
void FacetPairing::renew_facets(std::span<const TetId> tets) {
  std::vector<PairedFacet> facets;
  facets.reserve(facets_.size() + tets.size());
  auto old = facets_.begin();
  for (const TetId t : tets) {
    for (; old != facets_.end() && old->facet.tet() < t; ++old) facets.push_back(*old);
    for (; old != facets_.end() && old->facet.tet() == t; ++old) place_of_[old->facet.index()] = kNoPlace;
    append_facets_of(t, facets);
  }
  facets.insert(facets.end(), old, facets_.end());
  facets_ = std::move(facets);
}

// Around an edge with two restricted facets both ways lead from one to the other, so the walk through the tetrahedra
// above will do. It is taken for all edges; those that seem to have more than one way are left for pair_sides. Edges
// are counted by a hash: where two of them share it the only loss is time.
void FacetPairing::pair_uncontested_sides() {
  const std::size_t least = kCountsPerFacet * facets_.size() + 2;
  const unsigned shift = 64u - static_cast<unsigned>(std::bit_width(least));
  std::vector<std::uint8_t> ways(std::size_t{1} << (64u - shift), 0);  // found around each edge: 0, 1, 2 for more
  const auto ways_around = [&](const PairedFacet& facet, unsigned side) -> std::uint8_t& {
    const auto [low, high] = std::minmax(facet.vertices[(side + 1) % 3].value, facet.vertices[(side + 2) % 3].value);
    const std::uint64_t edge = std::uint64_t{high} << 32 | low;
    return ways[edge * std::uint64_t{0x9E3779B97F4A7C15} >> shift];
  };
  for (PairedFacet& facet : facets_) {
    for (unsigned side = 0; side < 3; ++side) {
      if (facet.known[side]) continue;
      join(facet, side, next_restricted_facet(restricted_, facet.facet, facet.vertices[side]), false);
      std::uint8_t& count = ways_around(facet, side);
      count = count == 0 ? 1 : 2;
    }
  }
  for (PairedFacet& facet : facets_) {
    for (unsigned side = 0; side < 3; ++side) facet.known[side] = ways_around(facet, side) < 2;
  }
}

void FacetPairing::pair_sides() {
  for (std::uint32_t i = 0; i < facets_.size(); ++i) place_of_[facets_[i].facet.index()] = i;
  for (PairedFacet& facet : facets_) {
    for (unsigned side = 0; side < 3; ++side) {
      if (!facet.known[side]) pair_side(facet, side);
    }
  }
}

// Pairs a side with another one, which thereby is paired, too.
void FacetPairing::pair_side(PairedFacet& facet, unsigned side) {
  const PairingAcross across = paired_across(restricted_, facet.facet, facet.vertices[side]);
  join(facet, side, across.partner, across.is_contested);
}

void FacetPairing::join(PairedFacet& facet, unsigned side, FacetId partner, bool is_contested) {
  facet.contested[side] = is_contested;
  facet.known[side] = true;
  facet.across[side] = PairedFacet::kUnpaired;
  if (place_of(partner) == kNoPlace) return;

  // Our edge runs the other way over there.
  const VertexId a = facet.vertices[(side + 1) % 3];
  const VertexId b = facet.vertices[(side + 2) % 3];
  PairedFacet& there = facets_[place_of(partner)];
  unsigned i = 0;
  while (i < 3 && !(there.vertices[(i + 1) % 3] == b && there.vertices[(i + 2) % 3] == a)) ++i;
  DELISO_CHECK(i < 3, "paired facets must share an edge");
  facet.across[side] = 4 * there.facet.value + i;
  there.across[i] = 4 * facet.facet.value + side;
  there.contested[i] = is_contested;
  there.known[i] = true;
}

}  // namespace deliso
