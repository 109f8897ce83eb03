// The triangulation as a whole: it is Delaunay, and depends on the points alone.
#include "delaunay/bowyer_watson.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/constructions.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::distinct;
using test::Points;
using test::some_live_tet;
using test::violation_of;

// Inserts all points one by one after a build on the shortest prefix that spans space. Duplicates are skipped.
void insert_one_by_one(BowyerWatson& tets, const Points& points, Rng& rng) {
  std::size_t next = 4;
  while (!tets.build(std::span(points).first(next))) ++next;
  for (; next < points.size(); ++next) {
    if (tets.find_conflicts(points[next], some_live_tet(tets, rng))) continue;
    tets.fill_cavity();
  }
}

TEST(BowyerWatson, CircumcentersOfAStarAreThoseOfItsTetrahedra) {
  Rng rng(11);
  for (const auto& [name, points] : test::all_kinds(100, rng)) {
    BowyerWatson tets(test::box_of(points));
    std::size_t next = 4;
    while (!tets.build(std::span(points).first(next))) ++next;
    for (; next < points.size(); ++next) {
      if (tets.find_conflicts(points[next], some_live_tet(tets, rng))) continue;
      tets.fill_cavity();
      std::vector<Vec3> centers(tets.created().size());
      tets.circumcenters_of_star(centers);
      for (std::size_t i = 0; i < centers.size(); ++i) {
        const TetId t = tets.created()[i];
        if (tets.is_ghost(t)) continue;
        const auto& v = tets.vertices(t);
        ASSERT_EQ(centers[i], circumcenter(tets.point(v[0]), tets.point(v[1]), tets.point(v[2]), tets.point(v[3])))
            << name << " vertex " << next;
      }
    }
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

TEST(BowyerWatson, SlotsAreReusedAtOnce) {
  Rng rng(13);
  const Points points = test::random_points(3000, rng);
  BowyerWatson tets(test::box_of(points));
  ASSERT_TRUE(tets.build(points));
  std::size_t live = 0;
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) live += tets.is_live(TetId(i));
  EXPECT_LT(tets.tet_slots(), live + 50);
}

}  // namespace
}  // namespace deliso
