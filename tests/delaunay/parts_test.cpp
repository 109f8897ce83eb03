// Parts of a triangulation: together their insertions must give the triangulation of all points.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;
using test::violation_of;

struct Counts {
  std::size_t inserted = 0, blocked = 0, duplicates = 0;
};

// Slabs between the planes, across an axis.
std::vector<Slab> slabs_between(const std::vector<double>& planes, std::size_t axis) {
  std::vector<Slab> slabs(planes.size() + 1);
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    slabs[k].axis = axis;
    if (k > 0) slabs[k].low = planes[k - 1];
    if (k < planes.size()) slabs[k].high = planes[k];
  }
  return slabs;
}

std::vector<std::unique_ptr<BowyerWatson>> parts_of(BowyerWatson& whole, const std::vector<Slab>& slabs,
                                                    std::size_t insertions) {
  std::vector<std::unique_ptr<BowyerWatson>> parts;
  for (const PartRoom& room : whole.make_rooms(slabs, insertions)) {
    parts.push_back(std::make_unique<BowyerWatson>(whole, room));
  }
  return parts;
}

// The parts try points in turn; a point that a part cannot insert goes to `left`. No other part works meanwhile, so a
// walk may search for the tetrahedron to start from.
void insert_by_turns(std::vector<std::unique_ptr<BowyerWatson>>& parts, const Points& points, Rng& rng, Points& left,
                     Counts& counts) {
  for (const Vec3& p : points) {
    BowyerWatson& part = *parts[rng.below(parts.size())];
    const TetId start = part.locate(p, part.incident_tet(VertexId(0)));
    const bool is_of_another = start.index() >= part.tet_slots();
    if (!part.has_room() || is_of_another) {
      left.push_back(p);
      continue;
    }
    part.find_conflicts(p, start);
    if (part.is_blocked()) {
      ++counts.blocked;
      left.push_back(p);
      continue;
    }
    ASSERT_GT(part.conflict_region().size(), 0u);
    part.fill_cavity();
    ++counts.inserted;
  }
}

void join(BowyerWatson& whole, std::vector<std::unique_ptr<BowyerWatson>>& parts) {
  for (const auto& part : parts) whole.join(*part);
  const std::vector<VertexId> renamed = whole.finish_join();
  std::size_t named = 0;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v].is_none()) continue;
    ASSERT_EQ(renamed[v], VertexId(named++)) << "in the same order";
  }
  ASSERT_EQ(named, whole.vertex_count());
}

// A quarter of the points is there; parts insert the rest, round after round, and the whole what they leave.
void build_in_parts(const std::string& name, const Points& all, std::size_t slab_count, Rng& rng, Counts& counts) {
  SCOPED_TRACE(name);
  const Points points = test::distinct(all);
  const Box3 box = test::box_of(points);
  BowyerWatson whole(box);
  Points left(points.begin() + static_cast<std::ptrdiff_t>(points.size() / 4), points.end());
  if (!whole.build(std::span(points).first(points.size() / 4))) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> planes;
    for (std::size_t k = 1; k < slab_count; ++k) planes.push_back(points[rng.below(points.size())][axis]);
    std::sort(planes.begin(), planes.end());
    auto parts = parts_of(whole, slabs_between(planes, axis), points.size() / 4);
    ASSERT_EQ(parts.size(), slab_count);
    Points waiting;
    std::swap(waiting, left);
    insert_by_turns(parts, waiting, rng, left, counts);
    join(whole, parts);
    ASSERT_EQ(violation_of(whole), "none");
  }
  for (const Vec3& p : left) {
    ASSERT_FALSE(whole.find_conflicts(p, whole.incident_tet(VertexId(0))));
    whole.fill_cavity();
  }
  ASSERT_EQ(whole.vertex_count(), points.size());
  BowyerWatson fresh(box);
  ASSERT_TRUE(fresh.build(whole.points()));
  EXPECT_EQ(test::tetrahedra_as_sets(whole), test::tetrahedra_as_sets(fresh));
}

// Ties among them, which are decided by the order of the vertices.
TEST(Parts, GiveTheTriangulationOfAllPointsInTheOrderOfTheirVertices) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    for (const std::size_t size : {80u, 900u}) {
      for (auto [name, points] : test::all_kinds(size, rng)) {
        test::shuffle(points, rng);
        const std::size_t slabs = 2 + rng.below(3);
        build_in_parts(name + ", seed " + std::to_string(seed), points, slabs, rng, counts);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(counts.inserted, 2000u);
  EXPECT_GT(counts.blocked, 2000u);
}

TEST(Parts, AreBlockedByWhatTheyMayNotTakeAway) {
  Rng rng(5);
  const Points points = test::random_points(2000, rng);
  BowyerWatson whole(test::box_of(points));
  ASSERT_TRUE(whole.build(std::span(points).first(1500)));
  const std::vector<Slab> slabs = slabs_between({0.5 * (whole.point(VertexId(0)).x + whole.point(VertexId(1)).x)}, 0);
  auto parts = parts_of(whole, slabs, 500);
  ASSERT_EQ(parts.size(), 2u);
  const auto crosses = [&](TetId t) {
    bool low = false, high = false;
    for (const VertexId v : whole.vertices(t)) {
      if (v == kInfiniteVertex) continue;
      (slabs[0].contains(whole.point(v)) ? low : high) = true;
    }
    return low && high;
  };
  std::size_t blocked = 0, found = 0;
  for (const Vec3& p : std::span(points).subspan(1500)) {
    bool expected = false;
    const BowyerWatson& part = *parts[slabs[0].contains(p) ? 0 : 1];
    for (std::size_t t = 0; t < whole.tet_slots(); ++t) {
      if (part.is_live(TetId(t)) && part.in_conflict(TetId(t), p)) expected = expected || crosses(TetId(t));
    }
    BowyerWatson& looking = *parts[slabs[0].contains(p) ? 0 : 1];
    looking.find_conflicts(p, looking.locate(p, TetId(looking.incident_tet(VertexId(0)))));
    EXPECT_EQ(looking.is_blocked(), expected);
    if (!looking.is_blocked()) looking.abandon_cavity();
    blocked += expected ? 1 : 0;
    found += expected ? 0 : 1;
  }
  EXPECT_GT(blocked, 20u);
  EXPECT_GT(found, 200u);
}

// Beyond the hull its conflict region may lie within the slab all the same.
TEST(Parts, AreBlockedByAPointBeyondTheirSlab) {
  Rng rng(6);
  const Points points = test::random_points(300, rng);
  Box3 box = test::box_of(points);
  const double plane = box.high.x + 0.25;
  box.extend({plane + 1, box.high.y, box.high.z});
  BowyerWatson whole(box);
  ASSERT_TRUE(whole.build(points));
  auto parts = parts_of(whole, slabs_between({plane}, 0), 10);
  ASSERT_EQ(parts.size(), 2u);
  std::size_t tried = 0;
  for (const double x : {plane, plane + 0.5}) {
    const Vec3 p{x, 0.5 * box.low.y + 0.5 * box.high.y, 0.5 * box.low.z + 0.5 * box.high.z};
    for (std::size_t i = 0; i < whole.tet_slots(); ++i) {
      const TetId t(i);
      if (!whole.is_live(t) || !whole.in_conflict(t, p)) continue;
      parts[0]->find_conflicts(p, t);
      EXPECT_TRUE(parts[0]->is_blocked());
      if (!parts[0]->is_blocked()) parts[0]->abandon_cavity();
      ++tried;
    }
  }
  EXPECT_GT(tried, 2u);
}

// Also without asking has_room(), which leaves a few hundred slots for large stars.
TEST(Parts, AreBlockedWhereAStarHasNoRoom) {
  Rng rng(8);
  const Points points = test::random_points(800, rng);
  BowyerWatson whole(test::box_of(points));
  ASSERT_TRUE(whole.build(std::span(points).first(300)));
  const auto rooms = whole.make_rooms(std::vector<Slab>(1), 500, 1, 0.0);
  ASSERT_EQ(rooms.size(), 1u);
  BowyerWatson part(whole, rooms[0]);
  std::size_t inserted = 0, blocked = 0;
  for (const Vec3& p : std::span(points).subspan(300)) {
    part.find_conflicts(p, part.locate(p, part.incident_tet(VertexId(0))));
    if (part.is_blocked()) {
      EXPECT_TRUE(part.conflict_region().empty());
      ++blocked;
    } else {
      ASSERT_NO_THROW(part.fill_cavity());
      ++inserted;
    }
  }
  EXPECT_GT(inserted, 20u);
  EXPECT_GT(blocked, 300u);
  whole.join(part);
  whole.finish_join();
  EXPECT_EQ(whole.vertex_count(), 300 + inserted);
  EXPECT_EQ(violation_of(whole), "none");
}

TEST(Parts, EndWhereTheirRoomDoes) {
  Rng rng(7);
  const Points points = test::random_points(1200, rng);
  BowyerWatson whole(test::box_of(points));
  ASSERT_TRUE(whole.build(std::span(points).first(400)));
  auto parts = parts_of(whole, slabs_between({0.5}, 1), 20);
  Points left;
  Counts counts;
  insert_by_turns(parts, Points(points.begin() + 400, points.end()), rng, left, counts);
  EXPECT_FALSE(parts[0]->has_room());
  EXPECT_FALSE(parts[1]->has_room());
  EXPECT_EQ(counts.inserted, 40u);
  for (const Vec3& p : std::span(left).first(30)) {
    const TetId start = parts[0]->locate(p, parts[0]->incident_tet(VertexId(0)));
    if (start.index() >= parts[0]->tet_slots()) continue;  // of the other part
    parts[0]->find_conflicts(p, start);
    EXPECT_TRUE(parts[0]->is_blocked());
  }
  join(whole, parts);
  EXPECT_EQ(whole.vertex_count(), 440u);
  EXPECT_EQ(violation_of(whole), "none");
  // What was not used is free for the next ones.
  const std::size_t slots = whole.tet_slots();
  for (const Vec3& p : std::span(left).first(30)) {
    whole.find_conflicts(p, whole.incident_tet(VertexId(0)));
    whole.fill_cavity();
  }
  EXPECT_EQ(whole.tet_slots(), slots);
  EXPECT_EQ(violation_of(whole), "none");
}

}  // namespace
}  // namespace deliso
