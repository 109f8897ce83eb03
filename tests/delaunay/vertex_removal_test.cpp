// Removals: what is left must be the triangulation of the points that are left.
#include <gtest/gtest.h>

#include <algorithm>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/predicates.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;
using test::violation_of;
using TetSet = std::set<std::array<std::uint32_t, 4>>;

std::vector<VertexId> live_vertices(const Tetrahedralization& tets) {
  std::vector<VertexId> live;
  for (std::size_t i = 0; i < tets.vertex_count(); ++i) {
    if (tets.is_live(VertexId(i))) live.push_back(VertexId(i));
  }
  return live;
}

// The tetrahedra of a triangulation built from the live vertices alone, in terms of the vertices of `tets`.
TetSet built_anew(const BowyerWatson& tets, const Box3& box) {
  const std::vector<VertexId> live = live_vertices(tets);
  Points points;
  for (const VertexId v : live) points.push_back(tets.point(v));
  BowyerWatson fresh(box);
  if (!fresh.build(points)) return {};
  TetSet renamed;
  for (std::array<std::uint32_t, 4> tet : test::tetrahedra_as_sets(fresh)) {
    for (std::uint32_t& v : tet) v = VertexId{v} == kInfiniteVertex ? v : live[v].value;
    std::sort(tet.begin(), tet.end());
    renamed.insert(tet);
  }
  return renamed;
}

bool all_coplanar(const Points& points) { return !BowyerWatson(test::box_of(points)).build(points); }

// Random points on a sphere, and its centre. If the centre comes late it connects to what is inside, which takes fewer
// tetrahedra, so slots stay free.
Points sphere_and_centre(std::size_t count, Rng& rng) {
  const Vec3 centre = {rng.uniform(), rng.uniform(), rng.uniform()};
  Points points;
  while (points.size() < count) {
    const Vec3 p = {2 * rng.uniform() - 1, 2 * rng.uniform() - 1, 2 * rng.uniform() - 1};
    if (norm(p) > 0.1 && norm(p) < 1) points.push_back(centre + p / norm(p));
  }
  points.push_back(centre);
  return points;
}

// Removes random vertices until the rest is coplanar; exactly then the removal must be refused.
void remove_all(const std::string& name, const Points& points, Rng& rng, std::size_t compare_every) {
  const Box3 box = test::box_of(points);
  BowyerWatson tets(box);
  ASSERT_TRUE(tets.build(points)) << name;
  std::size_t refusals = 0;
  for (std::size_t step = 0; refusals < 10; ++step) {
    const std::vector<VertexId> live = live_vertices(tets);
    const VertexId v = live[rng.below(live.size())];
    Points rest;
    for (const VertexId q : live) {
      if (q != v) rest.push_back(tets.point(q));
    }
    if (!tets.remove(v)) {
      ASSERT_TRUE(all_coplanar(rest)) << name << " with " << live.size() << " left";
      ASSERT_TRUE(tets.is_live(v));
      ++refusals;
    } else {
      ASSERT_FALSE(tets.is_live(v));
    }
    if (step % compare_every != 0 && live.size() > 12) continue;
    ASSERT_EQ(violation_of(tets), "none") << name << " with " << live.size() << " left";
    ASSERT_EQ(test::tetrahedra_as_sets(tets), built_anew(tets, box)) << name << " with " << live.size() << " left";
  }
  EXPECT_LE(live_vertices(tets).size(), points.size() / 2) << name;
}

TEST(VertexRemoval, LeavesTheTriangulationOfTheOthersAfterEveryRemoval) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    for (const auto& [name, points] : test::all_kinds(70, rng)) {
      remove_all(name + ", seed " + std::to_string(seed), points, rng, 1);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(VertexRemoval, LeavesTheTriangulationOfTheOthersInLargerSets) {
  Rng rng(11);
  for (const auto& [name, points] : test::all_kinds(600, rng)) {
    remove_all(name, points, rng, 50);
    if (HasFatalFailure()) return;
  }
}

using Going = BowyerWatson::Going;

// Marks this percentage of the vertices, and removes them together with those connected to them.
void remove_together(const std::string& name, const Points& points, Rng& rng, std::size_t percent) {
  const Box3 box = test::box_of(points);
  BowyerWatson tets(box);
  ASSERT_TRUE(tets.build(points)) << name;
  std::vector<Going> goes(tets.vertex_count(), Going::kNo);
  for (Going& going : goes) going = rng.below(100) < percent ? Going::kYes : Going::kNo;
  const std::vector<Going> wanted = goes;
  std::size_t calls = 0, gone = 0;
  for (std::size_t i = 0; i < goes.size(); ++i) {
    if (goes[i] != Going::kYes) continue;
    const std::vector<Going> before = goes;
    if (!tets.remove(VertexId(i), goes)) {
      ASSERT_EQ(goes, before) << name;
      ASSERT_EQ(test::tetrahedra_as_sets(tets), built_anew(tets, box)) << name << ": nothing changes";
      goes[i] = Going::kNo;
      continue;
    }
    ASSERT_EQ(goes[i], Going::kNo) << name;
    ++calls;
    for (std::size_t v = 0; v < goes.size(); ++v) {
      ASSERT_TRUE(goes[v] == before[v] || (before[v] == Going::kYes && goes[v] == Going::kNo)) << name;
      gone += goes[v] != before[v] ? 1 : 0;
    }
    if (calls % 8 != 1) continue;
    ASSERT_EQ(violation_of(tets), "none") << name;
    ASSERT_EQ(test::tetrahedra_as_sets(tets), built_anew(tets, box)) << name;
  }
  ASSERT_EQ(violation_of(tets), "none") << name;
  ASSERT_EQ(test::tetrahedra_as_sets(tets), built_anew(tets, box)) << name;
  for (std::size_t v = 0; v < goes.size(); ++v) {
    ASSERT_TRUE(wanted[v] == Going::kYes || tets.is_live(VertexId(v))) << name << ": no other goes";
  }
  EXPECT_TRUE(percent < 50 || gone <= 20 || calls < gone) << name << ": most hang together";
}

TEST(VertexRemoval, OfManyAtOnceLeavesTheTriangulationOfTheOthers) {
  for (const std::size_t percent : {5U, 30U, 60U, 95U, 100U}) {
    Rng rng(percent);
    for (const std::size_t count : {12U, 70U, 700U}) {
      for (const auto& [name, points] : test::all_kinds(count, rng)) {
        remove_together(name + ", " + std::to_string(percent) + " of 100", points, rng, percent);
        if (HasFatalFailure()) return;
      }
    }
  }
}

// A plane of points and a few on either side: links that are coplanar though what is left is not.
TEST(VertexRemoval, TakesApexesOffAPlane) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Points points;
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) points.push_back({double(x), double(y), 0});
    }
    for (int i = 0; i < 2; ++i) points.push_back({rng.uniform(1, 2), rng.uniform(1, 2), 1.0 + i});
    points.push_back({1.5, 1.5, -3});
    test::shuffle(points, rng);
    remove_all("plane, seed " + std::to_string(seed), points, rng, 1);
    if (HasFatalFailure()) return;
  }
}

TEST(VertexRemoval, MixesWithInsertions) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    for (const auto& [name, points] : test::all_kinds(120, rng)) {
      const Box3 box = test::box_of(points);
      BowyerWatson tets(box);
      std::size_t half = points.size() / 2;
      while (!tets.build(std::span(points).first(half))) ++half;
      Points outside(points.begin() + static_cast<std::ptrdiff_t>(half), points.end());
      for (int step = 0; step < 150; ++step) {
        const std::vector<VertexId> live = live_vertices(tets);
        if (rng.below(2) == 0) {
          const VertexId v = live[rng.below(live.size())];
          const Vec3 p = tets.point(v);
          if (tets.remove(v)) outside.push_back(p);
        } else if (!outside.empty()) {
          std::swap(outside[rng.below(outside.size())], outside.back());
          if (!tets.find_conflicts(outside.back(), tets.incident_tet(live[rng.below(live.size())]))) tets.fill_cavity();
          outside.pop_back();
        }
        if (step % 30 == 0) tets.close_gaps();
        if (step % 5 != 0) continue;
        ASSERT_EQ(violation_of(tets), "none") << name << ", seed " << seed << ", step " << step;
        ASSERT_EQ(test::tetrahedra_as_sets(tets), built_anew(tets, box)) << name << ", seed " << seed;
      }
    }
  }
}

TEST(VertexRemoval, TellsWhichTetrahedraGoAndCome) {
  Rng rng(5);
  for (const auto& [name, points] : test::all_kinds(100, rng)) {
    BowyerWatson tets(test::box_of(points));
    ASSERT_TRUE(tets.build(points)) << name;
    for (int step = 0; step < 20; ++step) {
      const std::vector<VertexId> live = live_vertices(tets);
      const VertexId v = live[rng.below(live.size())];
      const std::size_t slots = tets.tet_slots();
      std::vector<std::array<VertexId, 4>> before;
      for (std::size_t i = 0; i < slots; ++i) before.push_back(tets.vertices(TetId(i)));
      if (!tets.remove(v)) continue;
      std::set<TetId> changed(tets.destroyed().begin(), tets.destroyed().end());
      changed.insert(tets.created().begin(), tets.created().end());
      for (std::size_t i = 0; i < slots; ++i) {
        const auto& old = before[i];
        const bool had_v = !old[0].is_none() && std::find(old.begin(), old.end(), v) != old.end();
        const auto& destroyed = tets.destroyed();
        EXPECT_EQ(std::find(destroyed.begin(), destroyed.end(), TetId(i)) != destroyed.end(), had_v) << name;
        EXPECT_TRUE(changed.contains(TetId(i)) || tets.vertices(TetId(i)) == old) << name;
      }
      for (const TetId t : tets.created()) EXPECT_TRUE(tets.is_live(t)) << name;
    }
  }
}

TEST(VertexRemoval, ClosingGapsKeepsTheOrder) {
  Rng rng(6);
  const Points points = test::random_points(200, rng);
  BowyerWatson tets(test::box_of(points));
  ASSERT_TRUE(tets.build(points));
  for (std::size_t i = 0; i < points.size(); i += 3) ASSERT_TRUE(tets.remove(VertexId(i)));
  EXPECT_EQ(tets.vertex_count(), points.size());
  const std::vector<VertexId> renamed = tets.close_gaps();
  EXPECT_TRUE(tets.destroyed().empty());
  ASSERT_EQ(renamed.size(), points.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 3 == 0) {
      EXPECT_TRUE(renamed[i].is_none());
    } else {
      EXPECT_EQ(renamed[i], VertexId(count++));
      EXPECT_EQ(tets.point(renamed[i]), points[i]);
    }
  }
  EXPECT_EQ(tets.vertex_count(), count);
  EXPECT_EQ(violation_of(tets), "none");
}

// Lattice points lie on facets and edges, where a plain walk may end in any of the tetrahedra around.
TEST(PointLocation, OfMovedPointsDoesNotDependOnWhereTheWalkBegins) {
  Rng rng(7);
  const Points points = test::lattice(4, rng);
  BowyerWatson tets(Box3{{0, 0, 0}, {3, 3, 3}});
  ASSERT_TRUE(tets.build(points));
  std::size_t differing = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p{0.5 * double(rng.below(7)), 0.5 * double(rng.below(7)), 0.5 * double(rng.below(7))};
    Signs signs{};
    for (unsigned axis = 0; axis < 3; ++axis)
      signs[axis] = p[axis] == 0 ? 1 : p[axis] == 3 ? -1 : rng.below(2) == 0 ? 1 : -1;
    std::set<TetId> moved;
    std::set<TetId> plain;
    for (const VertexId v : live_vertices(tets)) {
      moved.insert(tets.locate_moved(p, signs, tets.incident_tet(v)));
      plain.insert(tets.locate(p, tets.incident_tet(v)));
    }
    ASSERT_EQ(moved.size(), 1u) << p.x << " " << p.y << " " << p.z;
    const TetId t = *moved.begin();
    ASSERT_FALSE(tets.is_ghost(t));
    differing += plain.size() > 1 ? 1 : 0;
    // The point moved by small amounts, which these coordinates have room for, lies strictly inside.
    const Vec3 q{p.x + 0x1p-8 * signs[0], p.y + 0x1p-16 * signs[1], p.z + 0x1p-24 * signs[2]};
    for (unsigned face = 0; face < 4; ++face) {
      const auto [a, b, c] = tets.facet_vertices(FacetId(t, face));
      EXPECT_LT(orient3d(tets.point(a), tets.point(b), tets.point(c), q), 0);
    }
  }
  EXPECT_GT(differing, 50u);
}

TEST(VertexRemoval, StartsFromATetrahedronThatIsThereWhereTheBuildLeftFreeSlots) {
  Rng rng(83);
  std::size_t with_free_slots = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const Points points = sphere_and_centre(40 + i % 60, rng);
    BowyerWatson tets(test::box_of(points));
    ASSERT_TRUE(tets.build(points));
    for (std::size_t t = 0; t < tets.tet_slots(); ++t) {
      if (tets.is_live(TetId(t))) continue;
      ++with_free_slots;
      break;
    }
    ASSERT_EQ(find_combinatorial_violation(tets).value_or("none"), "none") << i;
    const VertexId v(rng.below(tets.vertex_count()));
    ASSERT_TRUE(tets.remove(v));
    ASSERT_EQ(find_combinatorial_violation(tets).value_or("none"), "none") << i;
  }
  EXPECT_GT(with_free_slots, 10u);
}

}  // namespace
}  // namespace deliso
