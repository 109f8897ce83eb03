#include "surface/extract/facet_pairing.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

// Counters per facet for the number of restricted facets around edges; a facet has one edge and a half.
constexpr std::size_t kCountsPerFacet = 8;
// With fewer facets per thread, a thread costs more than it saves.
constexpr std::size_t kFewestFacets = 2048;

// Rotates from a restricted facet f about its edge opposite `third`, through the tetrahedra with the sign of f's own,
// to the next restricted facet. Both facets are seen from inside that sector.
template <class IsAbove>
FacetId next_restricted_facet(const Tetrahedralization& delaunay, const IsAbove& is_above, FacetId f, VertexId third) {
  const bool here = is_above(f.tet());
  for (;;) {
    const FacetId g = facet_opposite(delaunay, f.tet(), third);
    const FacetId beyond = delaunay.mirror(g);
    if (is_above(beyond.tet()) != here) return g;
    third = delaunay.vertices(f.tet())[f.face()];
    f = beyond;
  }
}

template <class IsAbove>
PairingAcross paired(const SignedDelaunay& restricted, const IsAbove& is_above, FacetId facet, VertexId third) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const FacetId around_above = next_restricted_facet(delaunay, is_above, facet, third);
  const FacetId around_below =
      delaunay.mirror(next_restricted_facet(delaunay, is_above, delaunay.mirror(facet), third));
  if (around_above == around_below) return {around_above, false};
  // The other two vertices are the ends of the edge.
  Vec3 sum;
  for (const VertexId v : delaunay.facet_vertices(facet)) {
    if (v != third) sum += delaunay.point(v);
  }
  return {restricted.isosurface().is_above(0.5 * sum) ? around_below : around_above, true};
}

}  // namespace

PairingAcross paired_across(const SignedDelaunay& restricted, FacetId facet, VertexId third) {
  return paired(
      restricted, [&](TetId t) { return restricted.is_above(t); }, facet, third);
}

FacetPairing::FacetPairing(const SignedDelaunay& restricted, TetSigns signs, int threads)
    : restricted_(restricted), delaunay_(restricted.delaunay()), signs_(std::move(signs)) {
  facets_ = collect_in_blocks<PairedFacet>(
      delaunay_.tet_slots(), threads,
      [&](std::size_t i, std::vector<PairedFacet>& facets) { append_facets_of(TetId(i), facets); });
  find_places();
  // A facet with a guard is not ours, but may share an edge with two facets that are.
  if (!restricted_.is_virtual(VertexId(delaunay_.vertex_count() - 1))) pair_uncontested_sides(threads);
  pair_sides(threads);
  is_split_.resize(delaunay_.vertex_count());
  find_split_vertices(std::vector<bool>(delaunay_.vertex_count(), true), threads);
}

PairedTriangles FacetPairing::triangles() const {
  PairedTriangles all;
  all.facets.reserve(facets_.size());
  all.triangles.reserve(facets_.size());
  all.neighbours.reserve(facets_.size());
  for (std::uint32_t t = 0; t < facets_.size(); ++t) {
    const PairedFacet& facet = facets_[t];
    all.facets.push_back(facet.facet);
    all.triangles.push_back({facet.vertices[0].value, facet.vertices[1].value, facet.vertices[2].value});
    all.neighbours.push_back(facet.across);
    for (unsigned i = 0; i < 3; ++i) {
      if (facet.contested[i]) all.contested.push_back(4 * t + i);
    }
  }
  all.is_split = is_split_;
  return all;
}

// Finds split vertices among those around which something has changed. It walks around a vertex from its first corner,
// one way and, if the fan is open, then the other. A vertex with more corners than the walk meets has another fan.
// Corner 3 t + i is that of facet t at its vertex i.
void FacetPairing::find_split_vertices(const std::vector<bool>& has_changed, int threads) {
  struct Corners {
    std::uint32_t first = 0, count = 0;
  };
  std::vector<Corners> corners(has_changed.size());
  for (auto corner = static_cast<std::uint32_t>(3 * facets_.size()); corner-- > 0;) {
    const std::size_t v = facets_[corner / 3].vertices[corner % 3].index();
    if (has_changed[v]) corners[v] = {corner, corners[v].count + 1};
  }
  const auto is_one_fan = [&](const Corners& at) {
    std::uint32_t met = 0;
    for_each_corner_of_fan(
        at.first, [&](TriangleSide side) { return facets_[side >> 2].across[side & 3u]; },
        [&](std::uint32_t corner) {
          const bool is_news = met < at.count && (met == 0 || corner != at.first);
          met += is_news ? 1 : 0;
          return is_news;
        });
    return met == at.count;
  };
  static_assert(kBlockSize % 64 == 0, "no two blocks share a word of bits");
  for_each_block(corners.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (has_changed[v]) is_split_[v] = corners[v].count > 0 && !is_one_fan(corners[v]);
    }
  });
}

void FacetPairing::append_facets_of(TetId t, std::vector<PairedFacet>& facets) const {
  if (!delaunay_.is_live(t) || !is_above(t)) return;
  for (unsigned face = 0; face < 4; ++face) {
    const FacetId f(t, face);
    if (is_above(delaunay_.neighbour(t, face))) continue;
    const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
    if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted_.is_virtual(q); })) continue;
    facets.push_back({f, v, {}, {}, {}});
  }
}

void FacetPairing::find_places() {
  first_of_.assign(delaunay_.tet_slots(), kNoPlace);
  for (std::size_t i = facets_.size(); i-- > 0;)
    first_of_[facets_[i].facet.tet().index()] = static_cast<std::uint32_t>(i);
}

// Around an edge with two restricted facets both directions lead from one to the other, so the walk through the
// tetrahedra above is enough. It is done for all edges; those that seem to have more than one pair of facets are left
// for pair_sides. Pairs are counted by a hash of the edge: if two edges share a counter, this only costs time. When the
// two facets of an edge are in different shares, each share walks from its own side.
void FacetPairing::pair_uncontested_sides(int threads) {
  const std::size_t least = kCountsPerFacet * facets_.size() + 2;
  const unsigned shift = 64u - static_cast<unsigned>(std::bit_width(least));
  constexpr std::uint8_t kOne = 1, kMore = 2;
  std::vector<std::uint8_t> ways(std::size_t{1} << (64u - shift), 0);  // pairs found around each edge, as flags
  const auto ways_around = [&](const PairedFacet& facet, unsigned side) -> std::uint8_t& {
    const auto [low, high] = std::minmax(facet.vertices[(side + 1) % 3].value, facet.vertices[(side + 2) % 3].value);
    const std::uint64_t edge = std::uint64_t{high} << 32 | low;
    return ways[edge * std::uint64_t{0x9E3779B97F4A7C15} >> shift];
  };
  const Shares shares(facets_.size(), threads, kFewestFacets);
  const auto count_way = [&](std::uint8_t& flags) {
    if (shares.count() == 1) {
      flags = flags == 0 ? kOne : kMore;
    } else if (std::atomic_ref(flags).fetch_or(kOne, std::memory_order_relaxed) != 0) {
      std::atomic_ref(flags).fetch_or(kMore, std::memory_order_relaxed);
    }
  };
  for_each_unknown_side(shares, threads, [&](PairedFacet& facet, unsigned side, const Share& share) {
    const FacetId partner = next_restricted_facet(
        delaunay_, [this](TetId t) { return is_above(t); }, facet.facet, facet.vertices[side]);
    const std::uint32_t place = join(facet, side, {partner, false}, share);
    if (number_of(facet) < place) count_way(ways_around(facet, side));
  });
  shares.for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (unsigned side = 0; side < 3; ++side) facets_[i].known[side] = ways_around(facets_[i], side) < kMore;
    }
  });
}

void FacetPairing::pair_sides(int threads) {
  const Shares shares(facets_.size(), threads, kFewestFacets);
  for_each_unknown_side(shares, threads, [&](PairedFacet& facet, unsigned side, const Share& share) {
    const auto above = [this](TetId t) { return is_above(t); };
    join(facet, side, paired(restricted_, above, facet.facet, facet.vertices[side]), share);
  });
}

// Calls visit(facet, side, share) for the sides not paired yet, share by share.
template <class Visit>
void FacetPairing::for_each_unknown_side(const Shares& shares, int threads, Visit&& visit) {
  shares.for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (unsigned side = 0; side < 3; ++side) {
        if (!facets_[i].known[side]) visit(facets_[i], side, Share{first, last});
      }
    }
  });
}

// Pairs a side with the side across. If the partner is in the same share, its side is paired, too. Returns the
// partner's index.
std::uint32_t FacetPairing::join(PairedFacet& facet, unsigned side, const PairingAcross& across, const Share& share) {
  const std::uint32_t place = place_of(across.partner);
  facet.contested[side] = across.is_contested;
  facet.known[side] = true;
  facet.across[side] = place == kNoPlace ? kNoSide : side_across(facet, side, place);
  if (place < share.first || place >= share.last) return place;

  PairedFacet& there = facets_[place];
  const unsigned i = facet.across[side] & 3u;
  there.across[i] = 4 * number_of(facet) + side;
  there.contested[i] = across.is_contested;
  there.known[i] = true;
  return place;
}

// The side of another facet at the same edge; its edge is directed the other way.
TriangleSide FacetPairing::side_across(const PairedFacet& facet, unsigned side, std::uint32_t place) const {
  const VertexId a = facet.vertices[(side + 1) % 3];
  const VertexId b = facet.vertices[(side + 2) % 3];
  const PairedFacet& there = facets_[place];
  unsigned i = 0;
  while (i < 3 && !(there.vertices[(i + 1) % 3] == b && there.vertices[(i + 2) % 3] == a)) ++i;
  DELISO_CHECK(i < 3, "paired facets must share an edge");
  return 4 * place + i;
}

}  // namespace deliso
