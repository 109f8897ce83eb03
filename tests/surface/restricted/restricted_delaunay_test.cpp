#include "surface/restricted/restricted_delaunay.h"

#include <gtest/gtest.h>

#include <limits>

#include "delaunay/constructions.h"
#include "tests/support/hit_tables.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::expect_consistent;
using testing::expect_right_quick_umbrellas;
using testing::FacetName;
using testing::field_scene;
using testing::hit_table;
using testing::HitTable;
using testing::missing_hits;
using testing::noise_scene;
using testing::Scene;

TEST(RestrictedDelaunay, EveryInsertionLeavesWhatAFreshComputationFinds) {
  std::vector<std::unique_ptr<Scene>> scenes;
  scenes.push_back(field_scene("torus", 16));
  scenes.push_back(field_scene("gyroid", 12));
  scenes.push_back(testing::wave_scene({9, 11, 7}, {1, 1, 4}, 3));
  scenes.push_back(noise_scene({5, 5, 5}, 1));
  scenes.push_back(noise_scene({3, 8, 4}, 2));
  for (const auto& scene : scenes) {
    Rng rng(11);
    SearchCounters counters;
    RestrictedDelaunay restricted(*scene->isosurface, scene->start());
    for (const Vec3& p : random_ray_points(*scene->isosurface, 40, rng, counters)) {
      restricted.insert(p, restricted.delaunay().incident_tet(restricted.last_vertex()), 0);
      SCOPED_TRACE(scene->name + " after vertex " + std::to_string(restricted.delaunay().vertex_count()));
      const RestrictedDelaunay fresh(*scene->isosurface, restricted.delaunay().points());
      ASSERT_EQ(testing::signs_by_name(restricted), testing::signs_by_name(fresh));
      expect_consistent(restricted);
      expect_right_quick_umbrellas(restricted);
      const HitTable ours = hit_table(restricted);
      const HitTable theirs = hit_table(fresh);
      EXPECT_EQ(missing_hits(ours, theirs), 0u);
      EXPECT_EQ(missing_hits(theirs, ours), 0u);
      if (::testing::Test::HasFailure()) return;
    }
    EXPECT_EQ(testing::odd_edges(restricted), 0u);
  }
}

// Against the definition of a Voronoi edge: a hit is on the surface, as far from the facet's vertices as from each
// other, and no vertex is nearer.
TEST(RestrictedDelaunay, HitsLieOnTheSurfaceAndOnTheVoronoiEdge) {
  for (const auto& scene : {field_scene("linked_tori", 32), field_scene("gyroid", 14), noise_scene({5, 6, 5}, 7)}) {
    SCOPED_TRACE(scene->name);
    const RestrictedDelaunay restricted(*scene->isosurface, scene->start());
    std::size_t off_surface = 0;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < restricted.dual_edge_slots(); ++i) {
      if (!restricted.is_alive(DualEdgeId(i))) continue;
      const DualEdge& edge = restricted.dual_edge(DualEdgeId(i));
      for (const Hit& hit : edge.hits) {
        const Vec3 x = edge.dual.at(hit.t);
        const double scale = 1 + std::abs(hit.t) + edge.radius;
        const double radius = distance(x, restricted.delaunay().point(edge.vertices[0]));
        for (const VertexId v : edge.vertices) {
          EXPECT_NEAR(distance(x, restricted.delaunay().point(v)), radius, 1e-8 * scale);
        }
        for (const Vec3& p : restricted.delaunay().points()) EXPECT_GT(distance(x, p), radius - 1e-6 * scale);
        const double steepness = norm(scene->isosurface->gradient(x));
        off_surface += std::abs(scene->isosurface->value(x)) > 1e-6 * scale * (1 + steepness) ? 1 : 0;
        ++hits;
      }
    }
    EXPECT_GT(hits, 30u);
    // Only hits that the signs put at the end of a dual edge, within rounding, may lie off it.
    EXPECT_LE(off_surface, hits / 200);
  }
}

// The dual edge from half spaces, one for every other vertex, and crossings from dense samples of the field along it.
TEST(RestrictedDelaunay, DenseSamplesAlongDualEdgesFindNoOtherHits) {
  const auto scene = field_scene("torus", 14);
  const RestrictedDelaunay restricted(*scene->isosurface, scene->start());
  const Tetrahedralization& delaunay = restricted.delaunay();
  const double reach = 2 * scene->isosurface->box().diagonal();
  std::size_t odd = 0;
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId f(TetId(i), face);
      if (!delaunay.is_live(TetId(i)) || delaunay.mirror(f) < f) continue;
      const auto v = delaunay.facet_vertices(f);
      if (v[0] == kInfiniteVertex || v[1] == kInfiniteVertex || v[2] == kInfiniteVertex) continue;
      const Vec3 &a = delaunay.point(v[0]), &b = delaunay.point(v[1]), &c = delaunay.point(v[2]);
      const Circumcircle circle = circumcircle(a, b, c);
      const Vec3 normal = cross(b - a, c - a) / norm(cross(b - a, c - a));
      double low = -reach;
      double high = reach;
      for (std::size_t q = 0; q < delaunay.vertex_count(); ++q) {
        if (VertexId(q) == v[0] || VertexId(q) == v[1] || VertexId(q) == v[2]) continue;
        // |x - a|^2 <= |x - d|^2 for x = center + t normal.
        const Vec3 d = delaunay.point(VertexId(q)) - circle.center;
        const double slope = 2 * dot(normal, d);
        const double bound = (squared_norm(d) - circle.radius * circle.radius) / slope;
        if (slope > 0) high = std::min(high, bound);
        if (slope < 0) low = std::max(low, bound);
      }
      int crossings = 0;
      constexpr int kSamples = 400;
      for (int s = 0; s < kSamples; ++s) {
        const auto above = [&](int n) {
          return scene->isosurface->is_above(circle.center + (low + (high - low) * n / kSamples) * normal);
        };
        crossings += above(s) != above(s + 1) ? 1 : 0;
      }
      const DualEdgeId e = restricted.dual_edge_of(f);
      const std::size_t hits = e.is_none() ? 0 : restricted.dual_edge(e).hits.size();
      EXPECT_GE(hits, static_cast<std::size_t>(crossings)) << "facet " << v[0].value << " " << v[1].value;
      EXPECT_EQ(restricted.is_restricted(f), crossings % 2 == 1);
      odd += crossings % 2 == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(odd, 10u);
}

TEST(RestrictedDelaunay, WhatIsTouchedIsAllThatChanged) {
  for (const auto& scene : {field_scene("torus", 16), noise_scene({5, 5, 5}, 3)}) {
    RestrictedDelaunay restricted(*scene->isosurface, scene->start());
    Rng rng(3);
    SearchCounters counters;
    for (const Vec3& p : random_ray_points(*scene->isosurface, 25, rng, counters)) {
      SCOPED_TRACE(scene->name + " after vertex " + std::to_string(restricted.delaunay().vertex_count()));
      const HitTable before = hit_table(restricted);
      const auto facets_before = testing::restricted_by_name(restricted);
      if (restricted.insert(p, TetId(restricted.delaunay().incident_tet(VertexId(0))), 0) !=
          RestrictedDelaunay::Outcome::kInserted) {
        continue;
      }
      std::set<FacetName> touched;
      for (const DualEdgeId e : restricted.touched_edges()) {
        if (restricted.is_alive(e)) {
          touched.insert(testing::name_of(restricted.delaunay(), restricted.dual_edge(e).facet));
        }
      }
      for (const auto& [facet, hits] : hit_table(restricted)) {
        const auto was = before.find(facet);
        if (was != before.end() && was->second.size() == hits.size()) continue;
        EXPECT_EQ(touched.count(facet), 1u);
      }
      std::set<std::uint32_t> vertices;
      for (const VertexId v : restricted.touched_vertices()) vertices.insert(v.value);
      const auto facets_after = testing::restricted_by_name(restricted);
      std::vector<FacetName> changed;
      std::set_symmetric_difference(facets_before.begin(), facets_before.end(), facets_after.begin(),
                                    facets_after.end(), std::back_inserter(changed));
      for (const FacetName& facet : changed) {
        for (const std::uint32_t v : facet) {
          EXPECT_TRUE(restricted.is_virtual(VertexId(v)) || vertices.count(v) == 1) << v;
        }
      }
    }
  }
}

TEST(RestrictedDelaunay, RefusedPointsChangeNothing) {
  const auto scene = field_scene("torus", 16);
  RestrictedDelaunay restricted(*scene->isosurface, scene->start());
  const auto signs = testing::signs_by_name(restricted);
  const Vec3 old = restricted.delaunay().point(VertexId(3));
  EXPECT_EQ(restricted.insert(old, restricted.delaunay().incident_tet(VertexId(0)), 0),
            RestrictedDelaunay::Outcome::kDuplicate);
  const Vec3 close = old + Vec3{1e-3, 2e-3, -1e-3};
  EXPECT_EQ(restricted.insert(close, restricted.delaunay().incident_tet(VertexId(0)), 0.01),
            RestrictedDelaunay::Outcome::kTooClose);
  EXPECT_EQ(testing::signs_by_name(restricted), signs);
  EXPECT_EQ(restricted.insert(close, restricted.delaunay().incident_tet(VertexId(0)), 1e-4),
            RestrictedDelaunay::Outcome::kInserted);
  EXPECT_NE(testing::signs_by_name(restricted), signs);
}

TEST(RestrictedDelaunay, TheSurfaceHitIsTheNearestThatCrossesAsTheSignsDo) {
  DualEdge edge;
  edge.hits = {{-3, true}, {-0.1, false}, {0.5, true}, {0.6, false}, {7, true}};
  EXPECT_EQ(surface_hit(edge), 0.5);
  edge.hits = {{-3, true}};
  EXPECT_EQ(surface_hit(edge), -3);
}

}  // namespace
}  // namespace deliso
