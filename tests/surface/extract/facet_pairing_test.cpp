#include "surface/extract/facet_pairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "delaunay/base/rng.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::dense;
using testing::noise_scene;
using testing::Scene;

// Turns over a few tetrahedra at random, or back those turned over before.
void turn_some(SignedDelaunay& restricted, std::uint64_t count, Rng& rng) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const TetId t(static_cast<std::size_t>(rng.below(restricted.delaunay().tet_slots())));
    if (restricted.delaunay().is_live(t)) restricted.flip_sign(t);
  }
}

void expect_same(const FacetPairing& a, const FacetPairing& b, std::uint64_t seed) {
  ASSERT_EQ(a.facets().size(), b.facets().size()) << "seed " << seed;
  for (std::uint32_t i = 0; i < a.facets().size(); ++i) {
    const PairedFacet& f = a.facets()[i];
    const PairedFacet& g = b.facets()[i];
    ASSERT_EQ(f.facet, g.facet) << "seed " << seed;
    ASSERT_EQ(f.vertices, g.vertices) << "seed " << seed;
    ASSERT_EQ(f.across, g.across) << "seed " << seed;
    ASSERT_EQ(f.contested, g.contested) << "seed " << seed;
    ASSERT_EQ(a.place_of(f.facet), i) << "seed " << seed;
  }
  ASSERT_EQ(a.triangles().is_split, b.triangles().is_split) << "seed " << seed;
}

TEST(FacetPairing, FollowsChangedSignsAsIfMadeAnew) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto scene = noise_scene({8, 7, 6}, seed);
    SignedDelaunay restricted = dense(*scene);
    FacetPairing pairing(restricted);
    EXPECT_FALSE(pairing.update());
    Rng rng(seed);
    for (const std::uint64_t count : {1u, 3u, 30u, 300u, 2u}) {
      const TetSigns before = restricted.signs();
      turn_some(restricted, count, rng);
      EXPECT_EQ(pairing.update(), restricted.signs() != before) << "seed " << seed;
      expect_same(pairing, FacetPairing(restricted), seed);
    }
  }
}

TEST(FacetPairing, IsTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto scene = noise_scene({18, 17, 15}, seed);
    SignedDelaunay restricted = dense(*scene);
    Rng rng(seed);
    turn_some(restricted, 300, rng);
    const FacetPairing one(restricted, 1);
    ASSERT_GT(one.facets().size(), 5u * 2048);  // one share of them for each thread
    for (const int threads : {2, 3, 5}) expect_same(FacetPairing(restricted, threads), one, seed);
  }
}

// Counts the restricted facets at every edge, those with virtual vertices included.
TEST(FacetPairing, ContestedEdgesHaveMoreThanTwoRestrictedFacets) {
  std::size_t contested = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto scene = noise_scene({9, 8, 7}, seed);
    SignedDelaunay restricted = dense(*scene);
    Rng rng(seed);
    turn_some(restricted, 50, rng);
    std::map<std::pair<VertexId, VertexId>, int> facets_at;
    const auto edge = [](VertexId a, VertexId b) { return std::pair(std::min(a, b), std::max(a, b)); };
    for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
      if (!restricted.delaunay().is_live(TetId(i)) || !restricted.is_above(TetId(i))) continue;
      for (unsigned face = 0; face < 4; ++face) {
        const FacetId f(TetId(i), face);
        if (!restricted.is_restricted(f)) continue;
        const auto v = restricted.delaunay().facet_vertices(f);
        for (unsigned side = 0; side < 3; ++side) ++facets_at[edge(v[side], v[(side + 1) % 3])];
      }
    }
    const FacetPairing pairing(restricted);
    for (const PairedFacet& facet : pairing.facets()) {
      for (unsigned side = 0; side < 3; ++side) {
        const int facets = facets_at[edge(facet.vertices[(side + 1) % 3], facet.vertices[(side + 2) % 3])];
        ASSERT_EQ(facet.contested[side], facets > 2) << "seed " << seed;
        contested += facets > 2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(contested, 100u);
}

TEST(FacetPairing, PairsSidesOfTheSameEdgeWithEachOther) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto scene = noise_scene({8, 7, 6}, seed);
    const SignedDelaunay restricted = dense(*scene);
    const FacetPairing pairing(restricted);
    std::size_t paired = 0;
    for (const PairedFacet& facet : pairing.facets()) {
      for (unsigned i = 0; i < 3; ++i) {
        if (facet.across[i] == kNoSide) continue;
        const PairedFacet& there = pairing.facets()[facet.across[i] >> 2];
        const unsigned j = facet.across[i] & 3u;
        EXPECT_EQ(there.across[j], 4 * pairing.place_of(facet.facet) + i) << "seed " << seed;
        EXPECT_EQ(there.contested[j], facet.contested[i]) << "seed " << seed;
        EXPECT_EQ(there.vertices[(j + 1) % 3], facet.vertices[(i + 2) % 3]) << "seed " << seed;
        EXPECT_EQ(there.vertices[(j + 2) % 3], facet.vertices[(i + 1) % 3]) << "seed " << seed;
        ++paired;
      }
    }
    EXPECT_GT(paired, pairing.facets().size());
  }
}

}  // namespace
}  // namespace deliso
