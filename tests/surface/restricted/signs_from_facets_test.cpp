// Facets restricted by the hits of their own dual edges: whether they bound a set of tetrahedra.
#include "surface/restricted/signs_from_facets.h"

#include <gtest/gtest.h>

#include "surface/certificate/certificate.h"
#include "surface/restricted/restricted_delaunay.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

template <class Function>
void for_each_facet(const SignedDelaunay& restricted, Function&& f) {
  for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
    if (!restricted.delaunay().is_live(TetId(i))) continue;
    for (unsigned face = 0; face < 4; ++face) f(FacetId(TetId(i), face));
  }
}

bool has_virtual_vertex(const SignedDelaunay& restricted, FacetId f) {
  const auto v = restricted.delaunay().facet_vertices(f);
  return std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted.is_virtual(q); });
}

// A triangulation in which the surface does not fall through one restricted facet.
class WithoutOneFacet : public SignedDelaunay {
 public:
  using SignedDelaunay::SignedDelaunay;
  void forget(FacetId f) { forgotten_ = f; }
  [[nodiscard]] bool falls_through(FacetId f) const override {
    return f != forgotten_ && SignedDelaunay::falls_through(f);
  }

 private:
  FacetId forgotten_;
};

TEST(SignsFromFacets, OfFacetsBySignsAreTheSigns) {
  for (const auto& scene : {field_scene("torus", 16), field_scene("gyroid", 12), noise_scene({5, 5, 5}, 1)}) {
    SCOPED_TRACE(scene->name);
    const SignedDelaunay restricted(*scene->isosurface, scene->start());
    const auto above = signs_from_facets(restricted);
    ASSERT_TRUE(above.has_value());
    for (std::size_t i = 0; i < above->size(); ++i) {
      if (restricted.delaunay().is_live(TetId(i))) {
        ASSERT_EQ((*above)[i], restricted.is_above(TetId(i)));
      }
    }
  }
}

TEST(SignsFromFacets, AreNotThereWhenAnyOneFacetIsMissing) {
  const auto scene = field_scene("torus", 12);
  WithoutOneFacet restricted(*scene->isosurface, scene->start());
  const std::size_t all = facets_alone(restricted).triangles.size();
  int tried = 0;
  for_each_facet(restricted, [&](FacetId f) {
    restricted.forget(FacetId());
    if (!restricted.falls_through(f)) return;
    restricted.forget(f);
    EXPECT_FALSE(signs_from_facets(restricted).has_value());
    EXPECT_EQ(facets_alone(restricted).triangles.size(), has_virtual_vertex(restricted, f) ? all : all - 1);
    ++tried;
  });
  EXPECT_GE(tried, 10);
}

TEST(FacetsAlone, OfASphereAreASphereSeenFromBelow) {
  const auto scene = field_scene("sphere", 16);
  const SignedDelaunay restricted(*scene->isosurface, scene->start());
  const TriangleMesh mesh = to_world(facets_alone(restricted), *scene->isosurface);
  EXPECT_EQ(certify(mesh, scene->topology).verdict, Verdict::kHomeomorphic);
  const Vec3 center = 0.5 * (scene->grid.box().low + scene->grid.box().high);
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.points[t[0]];
    EXPECT_GT(dot(cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a), a - center), 0);
  }
}

// Facet by facet: the rule agrees with a fresh search of the dual edge, and with the signs where no search contradicts
// them.
TEST(FacetRule, ByHitsIsTheParityOfTheDualEdge) {
  int without_contradiction = 0;
  for (const auto& scene : {field_scene("torus", 16), field_scene("gyroid", 12), noise_scene({5, 5, 5}, 1),
                            testing::wave_scene({9, 11, 7}, {1, 1, 4}, 3)}) {
    SCOPED_TRACE(scene->name);
    RestrictedDelaunay restricted(*scene->isosurface, scene->start(), FacetRule::kHits);
    Rng rng(7);
    SearchCounters counters;
    for (const Vec3& p : random_ray_points(*scene->isosurface, 40, rng, counters)) {
      restricted.insert(p, restricted.delaunay().incident_tet(restricted.last_vertex()), 0);
    }
    const bool agrees = restricted.hits_against_signs() == 0;
    without_contradiction += agrees ? 1 : 0;
    for_each_facet(restricted, [&](FacetId f) {
      const DualEdgeId e = restricted.dual_edge_of(f);
      const bool odd = !e.is_none() && restricted.dual_edge(e).hits.size() % 2 == 1;
      const bool by_signs = restricted.is_restricted(f);
      EXPECT_EQ(restricted.is_dual_to_surface(f), has_virtual_vertex(restricted, f) ? by_signs : odd);
      if (agrees) {
        EXPECT_EQ(restricted.falls_through(f), by_signs && restricted.is_above(f.tet()));
      }
      if (e.is_none()) return;
      const DualEdge& edge = restricted.dual_edge(e);
      std::vector<Hit> fresh;
      scene->isosurface->all_hits(edge.dual, edge.t_begin, edge.t_end, fresh, counters);
      EXPECT_EQ(fresh.size(), edge.hits.size());
    });
  }
  EXPECT_GE(without_contradiction, 2);
}

}  // namespace
}  // namespace deliso
