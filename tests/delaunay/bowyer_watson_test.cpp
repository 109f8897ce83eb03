#include "delaunay/bowyer_watson.h"

#include <gtest/gtest.h>

#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "delaunay/predicates.h"
#include "delaunay/validate.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;

std::string violation_of(const Tetrahedralization& tets) { return find_violation(tets).value_or("none"); }

// The points without those that equal an earlier one.
Points distinct(const Points& points) {
  Points result;
  for (const Vec3& p : points) {
    if (std::find(result.begin(), result.end(), p) == result.end()) result.push_back(p);
  }
  return result;
}

TetId some_live_tet(const BowyerWatson& tets, Rng& rng) {
  for (;;) {
    const TetId t(rng.below(tets.tet_slots()));
    if (tets.is_live(t)) return t;
  }
}

// Inserts all points one by one after a build on the shortest prefix that spans space. Duplicates are skipped.
void insert_one_by_one(BowyerWatson& tets, const Points& points, Rng& rng) {
  std::size_t next = 4;
  while (!tets.build(std::span(points).first(next))) ++next;
  for (; next < points.size(); ++next) {
    if (tets.find_conflicts(points[next], some_live_tet(tets, rng))) continue;
    tets.fill_cavity();
  }
}

TEST(BowyerWatson, IsValidAfterEveryInsertion) {
  Rng rng(1);
  for (const auto& [name, points] : test::all_kinds(100, rng)) {
    BowyerWatson tets(test::box_of(points));
    std::size_t next = 4;
    while (!tets.build(std::span(points).first(next))) ++next;
    for (; next < points.size(); ++next) {
      if (tets.find_conflicts(points[next], some_live_tet(tets, rng))) continue;
      const VertexId v = tets.fill_cavity();
      EXPECT_EQ(tets.point(v), points[next]);
      ASSERT_EQ(violation_of(tets), "none") << name << " after " << next + 1 << " points";
    }
    EXPECT_EQ(find_delaunay_violation_by_brute_force(tets).value_or("none"), "none") << name;
    EXPECT_EQ(tets.vertex_count(), distinct(points).size()) << name;
  }
}

TEST(BowyerWatson, BuildIsDelaunayByBruteForce) {
  Rng rng(2);
  for (const auto& [name, points] : test::all_kinds(400, rng)) {
    BowyerWatson tets(test::box_of(points));
    ASSERT_TRUE(tets.build(points)) << name;
    EXPECT_EQ(violation_of(tets), "none") << name;
    EXPECT_EQ(find_delaunay_violation_by_brute_force(tets).value_or("none"), "none") << name;
  }
}

TEST(BowyerWatson, BuildIsDelaunayByIntegersThatShareNoCode) {
  Rng rng(3);
  for (const Points& points : {test::lattice(3, rng), test::duplicates(60, rng), test::cocircular(rng)}) {
    BowyerWatson tets(test::box_of(points));
    ASSERT_TRUE(tets.build(points));
    for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
      if (!tets.is_live(TetId(i)) || tets.is_ghost(TetId(i))) continue;
      const auto& v = tets.vertices(TetId(i));
      const std::array<Vec3, 4> t = {tets.point(v[0]), tets.point(v[1]), tets.point(v[2]), tets.point(v[3])};
      ASSERT_GT(test::exact_orient3d(t, 0).sign(), 0);
      for (const Vec3& p : points) ASSERT_LE(test::exact_insphere({t[0], t[1], t[2], t[3], p}, 0), 0);
    }
  }
}

TEST(BowyerWatson, ResultDoesNotDependOnTheOrderOfInsertion) {
  Rng rng(4);
  for (const auto& kind : test::all_kinds(250, rng)) {
    const Points points = distinct(kind.points);
    // Inserted one by one, in the order of the indices.
    BowyerWatson in_order(test::box_of(points));
    insert_one_by_one(in_order, points, rng);
    // Built along the curve.
    BowyerWatson built(test::box_of(points));
    ASSERT_TRUE(built.build(points));
    EXPECT_EQ(test::tetrahedra_as_sets(built), test::tetrahedra_as_sets(in_order)) << kind.name;
    // Half built, then one by one.
    BowyerWatson mixed(test::box_of(points));
    std::size_t half = points.size() / 2;
    while (!mixed.build(std::span(points).first(half))) ++half;
    for (std::size_t i = half; i < points.size(); ++i) {
      ASSERT_FALSE(mixed.find_conflicts(points[i], some_live_tet(mixed, rng)));
      mixed.fill_cavity();
    }
    EXPECT_EQ(test::tetrahedra_as_sets(mixed), test::tetrahedra_as_sets(in_order)) << kind.name;
  }
}

// Mirrored coordinates send build() along a wholly different curve; the ties it meets are the same.
TEST(BowyerWatson, ResultDoesNotDependOnTheCurve) {
  Rng rng(5);
  for (const auto& kind : test::all_kinds(250, rng)) {
    const Points points = distinct(kind.points);
    BowyerWatson original(test::box_of(points));
    ASSERT_TRUE(original.build(points));
    for (const Vec3& flip : {Vec3{-1, 1, 1}, Vec3{-1, -1, 1}, Vec3{1, -1, -1}}) {
      Points mirrored;
      for (const Vec3& p : points) mirrored.push_back(scaled(flip, Vec3{p.y, p.z, p.x}));
      BowyerWatson other(test::box_of(mirrored));
      ASSERT_TRUE(other.build(mirrored));
      EXPECT_EQ(test::tetrahedra_as_sets(other), test::tetrahedra_as_sets(original)) << kind.name;
    }
  }
}

TEST(BowyerWatson, SameInputGivesTheSameArrays) {
  Rng rng(6);
  const Points points = test::box_faces(2000, rng);
  BowyerWatson first(test::box_of(points));
  BowyerWatson second(test::box_of(points));
  ASSERT_TRUE(first.build(points));
  second.build(test::random_points(10, rng));
  ASSERT_TRUE(second.build(points));
  ASSERT_EQ(first.tet_slots(), second.tet_slots());
  for (std::size_t i = 0; i < first.tet_slots(); ++i) {
    ASSERT_EQ(first.vertices(TetId(i)), second.vertices(TetId(i)));
    for (unsigned face = 0; face < 4; ++face) {
      ASSERT_EQ(first.mirror(FacetId(TetId(i), face)), second.mirror(FacetId(TetId(i), face)));
    }
  }
}

TEST(BowyerWatson, VertexOfMapsEachPointToTheFirstEqualOne) {
  Rng rng(7);
  for (int round = 0; round < 20; ++round) {
    Points points = test::duplicates(150, rng);
    points.push_back({-0.0, 0, 0});  // equals +0
    BowyerWatson tets(test::box_of(points));
    std::vector<VertexId> vertex_of;
    ASSERT_TRUE(tets.build(points, &vertex_of));
    const Points expected = distinct(points);
    ASSERT_EQ(tets.vertex_count(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(tets.point(VertexId(i)), expected[i]);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(tets.point(vertex_of[i]), points[i]);
    ASSERT_EQ(violation_of(tets), "none");
  }
}

TEST(BowyerWatson, BuildRefusesCoplanarPoints) {
  Rng rng(8);
  Points plane;
  for (int i = 0; i < 100; ++i) {
    const auto a = double(rng.below(20));
    const auto b = double(rng.below(20));
    plane.push_back({a, b, a + 2 * b});
  }
  BowyerWatson tets({{-100, -100, -100}, {100, 100, 100}});
  std::vector<VertexId> vertex_of;
  EXPECT_FALSE(tets.build(plane, &vertex_of));
  EXPECT_EQ(tets.vertex_count(), 0U);
  EXPECT_EQ(tets.tet_slots(), 0U);
  EXPECT_FALSE(tets.build(std::span(plane).first(0)));
  EXPECT_FALSE(tets.build(std::span(plane).first(3)));
  EXPECT_FALSE(tets.build(Points(10, Vec3{1, 2, 3})));
  plane.push_back({0, 0, 1});
  EXPECT_TRUE(tets.build(plane));
  EXPECT_EQ(violation_of(tets), "none");
}

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

TEST(BowyerWatson, SlotsAreReusedAtOnce) {
  Rng rng(13);
  const Points points = test::random_points(3000, rng);
  BowyerWatson tets(test::box_of(points));
  ASSERT_TRUE(tets.build(points));
  std::size_t live = 0;
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) live += tets.is_live(TetId(i));
  EXPECT_LT(tets.tet_slots(), live + 50);
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
