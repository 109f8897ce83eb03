// The tetrahedra that a moved segment passes through, against all facets that a segment moved by a small step crosses.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/predicates.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;

// Small against differences of determinants of small integers, and so large that sums with these are exact.
constexpr double kSmallStep = 0x1p-12;

Vec3 moved(const Vec3& p, const Signs& s) {
  return p + Vec3{kSmallStep * s[0], kSmallStep * kSmallStep * s[1], kSmallStep * kSmallStep * kSmallStep * s[2]};
}

int side_of_zero(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

bool crosses(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r) {
  if (side_of_zero(orient3d(p, q, r, a)) * side_of_zero(orient3d(p, q, r, b)) >= 0) return false;
  const int turn = side_of_zero(orient3d(a, b, p, q));
  return turn != 0 && turn == side_of_zero(orient3d(a, b, q, r)) && turn == side_of_zero(orient3d(a, b, r, p));
}

// All tetrahedra, ghosts included, on either side of facets that the segment crosses.
std::set<TetId> crossed_by(const BowyerWatson& tets, const Vec3& a, const Vec3& b) {
  std::set<TetId> crossed;
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
    const TetId t(i);
    if (!tets.is_live(t) || tets.is_ghost(t)) continue;
    for (unsigned face = 0; face < 4; ++face) {
      const auto [p, q, r] = tets.facet_vertices(FacetId(t, face));
      if (!crosses(a, b, tets.point(p), tets.point(q), tets.point(r))) continue;
      crossed.insert(t);
      crossed.insert(tets.neighbour(t, face));
    }
  }
  return crossed;
}

Vec3 integer_point(Rng& rng, double n) {
  return {std::floor(n * rng.uniform()), std::floor(n * rng.uniform()), std::floor(n * rng.uniform())};
}

// Returns how many tetrahedra were passed.
std::size_t compare(const BowyerWatson& tets, const Vec3& a, const Vec3& b, const Signs& signs) {
  const TetId from = tets.locate_moved(a, signs, tets.incident_tet(VertexId(std::size_t{0})));
  if (a == b || tets.is_ghost(from)) return 0;
  std::vector<Passage> passed;
  tets.append_passed_moved(a, b, signs, from, passed);
  std::set<TetId> expected = crossed_by(tets, moved(a, signs), moved(b, signs));
  expected.erase(from);
  std::set<TetId> found;
  for (const Passage& p : passed) found.insert(p.tet);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(passed.size(), expected.size());
  if (!passed.empty() && !tets.is_ghost(passed.back().tet)) {
    EXPECT_EQ(passed.back().tet, tets.locate_moved(b, signs, from));
  }
  return passed.size();
}

// Between integer points most segments meet vertices and edges, and lie in facets.
TEST(SegmentPassage, IsThatOfASegmentMovedByASmallStep) {
  Rng rng(7);
  std::size_t passed = 0;
  for (int round = 0; round < 40; ++round) {
    Points points;
    for (int i = 0; i < 40; ++i) points.push_back(integer_point(rng, 5));
    BowyerWatson tets({{-1, -1, -1}, {6, 6, 6}});
    if (!tets.build(points)) continue;
    for (int i = 0; i < 30; ++i) {
      const Vec3 a = integer_point(rng, 5);
      Vec3 b = integer_point(rng, 5);
      if (i % 2 == 0) b.y = a.y;
      if (i % 3 == 0) b.x = a.x;
      Signs signs;
      for (int& s : signs) s = rng.uniform() < 0.5 ? -1 : 1;
      passed += compare(tets, a, b, signs);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(passed, 1000u);
}

TEST(SegmentPassage, EndsBehindTheHull) {
  BowyerWatson tets({{-1, -1, -1}, {6, 6, 6}});
  ASSERT_TRUE(tets.build(Points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}));
  const Signs signs{1, 1, 1};
  const TetId from = tets.locate_moved({0, 0, 0}, signs, tets.incident_tet(VertexId(std::size_t{0})));
  std::vector<Passage> passed;
  tets.append_passed_moved({0, 0, 0}, {4, 4, 4}, signs, from, passed);
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_TRUE(tets.is_ghost(passed[0].tet));
}

}  // namespace
}  // namespace deliso
