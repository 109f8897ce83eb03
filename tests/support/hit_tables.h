// The dual edges and umbrellas of a restricted Delaunay triangulation, in a form that does not depend on how its
// elements are numbered.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "surface/restricted/restricted_delaunay.h"
#include "tests/support/surface_oracle.h"

namespace deliso::testing {

// The hits of each dual edge as points, along the edge, by the name of its facet.
struct NamedHit {
  Vec3 point;
  double from_end = 0;  // distance along the line to the nearer end of the dual edge
};
using HitTable = std::map<FacetName, std::vector<NamedHit>>;

inline HitTable hit_table(const RestrictedDelaunay& restricted) {
  HitTable table;
  for (std::size_t i = 0; i < restricted.dual_edge_slots(); ++i) {
    const DualEdgeId e(i);
    if (!restricted.is_alive(e)) continue;
    const DualEdge& edge = restricted.dual_edge(e);
    EXPECT_FALSE(edge.hits.empty());
    EXPECT_EQ(restricted.dual_edge_of(edge.facet), e);
    EXPECT_EQ(restricted.dual_edge_of(restricted.delaunay().mirror(edge.facet)), e);
    auto& hits = table[name_of(restricted.delaunay(), edge.facet)];
    EXPECT_TRUE(hits.empty()) << "two dual edges of one facet";
    for (const Hit& hit : edge.hits) {
      hits.push_back({edge.dual.at(hit.t), std::min(std::abs(hit.t - edge.t_begin), std::abs(hit.t - edge.t_end))});
    }
  }
  return table;
}

// Hits ascend, alternate, and agree with the two signs; facets that are restricted have a dual edge.
inline void expect_consistent(const RestrictedDelaunay& restricted) {
  for (std::size_t i = 0; i < restricted.dual_edge_slots(); ++i) {
    const DualEdgeId e(i);
    if (!restricted.is_alive(e)) continue;
    const DualEdge& edge = restricted.dual_edge(e);
    EXPECT_EQ(edge.hits.front().falling, restricted.is_above(edge.facet.tet()));
    EXPECT_EQ(edge.hits.back().falling, !restricted.is_above(restricted.delaunay().mirror(edge.facet).tet()));
    for (std::size_t h = 1; h < edge.hits.size(); ++h) {
      EXPECT_LE(edge.hits[h - 1].t, edge.hits[h].t);
      EXPECT_NE(edge.hits[h - 1].falling, edge.hits[h].falling);
    }
    EXPECT_EQ(edge.hits.size() % 2 == 1, restricted.is_restricted(edge.facet));
  }
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    if (!delaunay.is_live(TetId(i))) continue;
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId f(TetId(i), face);
      const auto v = delaunay.facet_vertices(f);
      const bool is_virtual = std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted.is_virtual(q); });
      EXPECT_TRUE(is_virtual || !restricted.is_restricted(f) || !restricted.dual_edge_of(f).is_none());
    }
  }
}

inline bool has_near(const std::vector<NamedHit>& hits, const Vec3& p, double tolerance) {
  return std::any_of(hits.begin(), hits.end(), [&](const NamedHit& h) { return distance(h.point, p) <= tolerance; });
}

// Quick umbrella shapes are right or not known, and known for most of those that are disks or half disks.
inline void expect_right_quick_umbrellas(RestrictedDelaunay& restricted) {
  const auto facets = restricted_by_name(restricted);
  int simple = 0;
  int known = 0;
  for (std::size_t i = 0; i < restricted.delaunay().vertex_count(); ++i) {
    const VertexId q(i);
    if (restricted.is_virtual(q)) continue;
    const UmbrellaShape shape = brute_umbrella(restricted, facets, q);
    const UmbrellaShape quick = restricted.quick_umbrella_shape(q);
    EXPECT_TRUE(quick == shape || quick == UmbrellaShape::kBroken) << "vertex " << i;
    simple += shape != UmbrellaShape::kBroken ? 1 : 0;
    known += quick != UmbrellaShape::kBroken ? 1 : 0;
  }
  EXPECT_LE(simple, 2 * known);
}

// Hits of one table that are missing in the other, those within rounding of the end of their dual edge left out.
inline std::size_t missing_hits(const HitTable& table, const HitTable& other) {
  constexpr double kRounding = 1e-5;
  std::size_t missing = 0;
  for (const auto& [facet, hits] : table) {
    const auto there = other.find(facet);
    for (const NamedHit& hit : hits) {
      if (hit.from_end < kRounding) continue;
      if (there == other.end() || !has_near(there->second, hit.point, kRounding * (1 + norm(hit.point)))) ++missing;
    }
  }
  return missing;
}

}  // namespace deliso::testing
