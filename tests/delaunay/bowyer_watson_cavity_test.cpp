// One insertion, step by step: the search, the region in conflict, its rim, and what fills the cavity.
#include <gtest/gtest.h>

#include <set>
#include <span>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/predicates.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::distinct;
using test::Points;
using test::some_live_tet;
using test::violation_of;

TEST(BowyerWatson, RefusesAPointOutsideItsBox) {
  Rng rng(9);
  BowyerWatson tets({{0, 0, 0}, {1, 1, 1}});
  ASSERT_TRUE(tets.build(test::random_points(20, rng)));
  EXPECT_THROW(tets.find_conflicts({2, 0, 0}, TetId(std::size_t{0})), InternalError);
  EXPECT_THROW(tets.fill_cavity(), InternalError);
}

TEST(BowyerWatson, ReportsTheDuplicatedVertexFromAnyStart) {
  Rng rng(10);
  for (const auto& kind : test::all_kinds(80, rng)) {
    const Points points = distinct(kind.points);
    BowyerWatson tets(test::box_of(points));
    ASSERT_TRUE(tets.build(points));
    const auto before = test::tetrahedra_as_sets(tets);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(tets.find_conflicts(points[i], some_live_tet(tets, rng)), VertexId(i)) << kind.name;
      ASSERT_TRUE(tets.conflict_region().empty());
    }
    ASSERT_EQ(test::tetrahedra_as_sets(tets), before);
  }
}

// The region is exactly the set of tetrahedra in conflict; the rim is its boundary, seen from outside.
TEST(BowyerWatson, RegionIsAllThatIsInConflict) {
  Rng rng(11);
  for (const auto& kind : test::all_kinds(120, rng)) {
    const Points points = distinct(kind.points);
    const std::size_t half = points.size() * 2 / 3;
    BowyerWatson tets(test::box_of(points));
    if (!tets.build(std::span(points).first(half))) continue;
    for (std::size_t i = half; i < points.size(); ++i) {
      ASSERT_FALSE(tets.find_conflicts(points[i], some_live_tet(tets, rng)));
      const std::set<TetId> region(tets.conflict_region().begin(), tets.conflict_region().end());
      ASSERT_EQ(region.size(), tets.conflict_region().size());
      std::set<FacetId> boundary;
      for (std::size_t k = 0; k < tets.tet_slots(); ++k) {
        const TetId t(k);
        if (!tets.is_live(t)) continue;
        ASSERT_EQ(tets.in_conflict(t, points[i]), region.count(t) == 1) << kind.name;
        for (unsigned face = 0; face < 4; ++face) {
          if (region.count(t) == 0 && region.count(tets.neighbour(t, face)) == 1) boundary.insert(FacetId(t, face));
        }
      }
      ASSERT_EQ(std::set<FacetId>(tets.rim().begin(), tets.rim().end()), boundary);
      ASSERT_EQ(tets.rim().size(), boundary.size());
      tets.fill_cavity();
    }
  }
}

TEST(BowyerWatson, CreatedTetrahedraStandOverTheRimOneByOne) {
  Rng rng(12);
  for (const auto& kind : test::all_kinds(120, rng)) {
    const Points points = distinct(kind.points);
    BowyerWatson tets(test::box_of(points));
    std::size_t next = 4;
    while (!tets.build(std::span(points).first(next))) ++next;
    for (; next < points.size(); ++next) {
      ASSERT_FALSE(tets.find_conflicts(points[next], some_live_tet(tets, rng)));
      const std::vector<FacetId> rim(tets.rim().begin(), tets.rim().end());
      const std::vector<TetId> region(tets.conflict_region().begin(), tets.conflict_region().end());
      const VertexId v = tets.fill_cavity();
      ASSERT_EQ(v, VertexId(next));
      ASSERT_EQ(tets.created().size(), rim.size());
      for (std::size_t i = 0; i < rim.size(); ++i) {
        const TetId t = tets.created()[i];
        ASSERT_EQ(tets.vertices(t)[0], v);
        ASSERT_EQ(tets.mirror(FacetId(t, 0)), rim[i]);
        ASSERT_EQ(tets.mirror(rim[i]), FacetId(t, 0));
      }
      // Nothing that was destroyed is left: all live tetrahedra with the apex are the created ones.
      std::size_t star = 0;
      for (std::size_t k = 0; k < tets.tet_slots(); ++k) {
        star += tets.is_live(TetId(k)) && tets.vertices(TetId(k))[0] == v;
      }
      ASSERT_EQ(star, rim.size());
      ASSERT_TRUE(tets.conflict_region().empty());
    }
  }
}

// The center of a sphere is in conflict with everything inside it: a rim of thousands of facets.
TEST(BowyerWatson, FillsAnEnormousCavity) {
  Rng rng(16);
  Points points = test::rounded_sphere(3000, rng);
  BowyerWatson tets({{-1, -1, -1}, {1, 1, 1}});
  ASSERT_TRUE(tets.build(points));
  ASSERT_FALSE(tets.find_conflicts({1e-3, 2e-3, 0}, some_live_tet(tets, rng)));
  ASSERT_GT(tets.rim().size(), 4000U);
  tets.fill_cavity();
  EXPECT_EQ(violation_of(tets), "none");
}

TEST(BowyerWatson, AbandonedCavityLeavesEverythingUntouched) {
  Rng rng(14);
  for (const auto& kind : test::all_kinds(100, rng)) {
    const Points points = distinct(kind.points);
    BowyerWatson tets(test::box_of(points));
    if (!tets.build(std::span(points).first(points.size() / 2))) continue;
    const auto before = test::tetrahedra_as_sets(tets);
    for (std::size_t i = points.size() / 2; i < points.size(); ++i) {
      ASSERT_FALSE(tets.find_conflicts(points[i], some_live_tet(tets, rng)));
      tets.abandon_cavity();
      ASSERT_TRUE(tets.conflict_region().empty());
      ASSERT_TRUE(tets.rim().empty());
    }
    EXPECT_EQ(test::tetrahedra_as_sets(tets), before);
    EXPECT_EQ(violation_of(tets), "none");
  }
}

TEST(BowyerWatson, LocateFindsTheTetrahedronAroundAPoint) {
  Rng rng(15);
  for (const auto& kind : test::all_kinds(200, rng)) {
    const Box3 box{test::box_of(kind.points).low - Vec3{1, 1, 1}, test::box_of(kind.points).high + Vec3{1, 1, 1}};
    BowyerWatson tets(box);
    ASSERT_TRUE(tets.build(kind.points));
    Points queries = kind.points;
    for (int i = 0; i < 100; ++i) queries.push_back(box.low + scaled(box.size(), test::random_points(1, rng)[0]));
    for (const Vec3& q : queries) {
      const TetId t = tets.locate(q, some_live_tet(tets, rng));
      ASSERT_TRUE(tets.is_live(t));
      if (tets.is_ghost(t)) {
        const auto& v = tets.vertices(t);
        ASSERT_GT(orient3d(tets.point(v[0]), tets.point(v[1]), tets.point(v[2]), q), 0) << kind.name;
        continue;
      }
      for (unsigned face = 0; face < 4; ++face) {
        const auto [a, b, c] = tets.facet_vertices(FacetId(t, face));
        ASSERT_LE(orient3d(tets.point(a), tets.point(b), tets.point(c), q), 0) << kind.name;
      }
    }
  }
}

}  // namespace
}  // namespace deliso
