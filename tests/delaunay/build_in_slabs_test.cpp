// Triangulations built by parts, compared with those built in one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "tests/support/delaunay_oracle.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;

constexpr std::size_t kCount = 18'000;  // parts are for sixteen thousand and more

// On a grid, where most points are cospherical with others and many are equal.
Points integer_points(Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < kCount; ++i) {
    points.push_back({double(rng.below(40)), double(rng.below(40)), double(rng.below(90))});
  }
  return points;
}

// On two thin tubes, so that tetrahedra reach from one to the other and across any plane.
Points tubes(Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = 6.2831853 * rng.uniform();
    points.push_back({rng.uniform(), 0.05 * std::cos(angle) + double(i % 2), 0.05 * std::sin(angle)});
  }
  return points;
}

void expect_same_slots(const BowyerWatson& a, const BowyerWatson& b) {
  ASSERT_EQ(a.tet_slots(), b.tet_slots());
  for (std::size_t i = 0; i < a.tet_slots(); ++i) {
    const TetId t(i);
    ASSERT_EQ(a.vertices(t), b.vertices(t));
    for (unsigned face = 0; a.is_live(t) && face < 4; ++face) {
      ASSERT_EQ(a.mirror(FacetId(t, face)), b.mirror(FacetId(t, face)));
    }
  }
}

TEST(BuildInSlabs, GivesTheTriangulationThatIsBuiltInOne) {
  Rng rng(11);
  std::vector<std::pair<std::string, Points>> kinds = {{"random", test::random_points(kCount, rng)},
                                                       {"integers", integer_points(rng)},
                                                       {"tubes", tubes(rng)},
                                                       {"twice", test::twice_in_shared_cells(30'000, rng)}};
  for (const auto& [name, points] : kinds) {
    SCOPED_TRACE(name);
    const Box3 box = test::box_of(points);
    BowyerWatson in_one(box), by_parts(box), by_two(box);
    std::vector<VertexId> expected, found;
    ASSERT_TRUE(in_one.build(points, &expected));
    ASSERT_TRUE(by_parts.build_in_slabs(points, &found, 1));
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(
        std::equal(in_one.points().begin(), in_one.points().end(), by_parts.points().begin(), by_parts.points().end()));
    EXPECT_EQ(test::tetrahedra_as_sets(by_parts), test::tetrahedra_as_sets(in_one));
    EXPECT_EQ(test::violation_of(by_parts), "none");
    ASSERT_TRUE(by_two.build_in_slabs(points, &found, 2));
    EXPECT_EQ(found, expected);
    expect_same_slots(by_two, by_parts);
  }
}

// Later insertions find a triangulation like any other.
TEST(BuildInSlabs, LeavesNoGaps) {
  Rng rng(12);
  const Points points = test::random_points(kCount + 200, rng);
  BowyerWatson tets(test::box_of(points));
  ASSERT_TRUE(tets.build_in_slabs(std::span(points).first(kCount), nullptr, 2));
  ASSERT_EQ(tets.vertex_count(), kCount);
  for (std::size_t v = 0; v < kCount; ++v) {
    ASSERT_EQ(tets.point(VertexId(v)), points[v]);
    const auto& corners = tets.vertices(tets.incident_tet(VertexId(v)));
    ASSERT_NE(std::find(corners.begin(), corners.end(), VertexId(v)), corners.end());
  }
  for (std::size_t i = 0; i < 200; ++i) {
    ASSERT_TRUE(tets.remove(VertexId(3 * i)));
    ASSERT_FALSE(tets.find_conflicts(points[kCount + i], tets.incident_tet(VertexId(3 * i + 1))));
    tets.fill_cavity();
  }
  tets.close_gaps();
  EXPECT_EQ(tets.vertex_count(), kCount);
  EXPECT_EQ(test::violation_of(tets), "none");
}

TEST(BuildInSlabs, RefusesCoplanarPoints) {
  Rng rng(13);
  Points points = test::random_points(kCount, rng);
  for (Vec3& p : points) p.y = 0.25;
  BowyerWatson tets(test::box_of(points));
  EXPECT_FALSE(tets.build_in_slabs(points, nullptr, 2));
  EXPECT_EQ(tets.vertex_count(), 0u);
  points.push_back({0.5, 0.75, 0.5});  // and takes them with a single point off their plane
  BowyerWatson pyramid(test::box_of(points));
  std::vector<VertexId> vertex_of;
  ASSERT_TRUE(pyramid.build_in_slabs(points, &vertex_of, 2));
  EXPECT_EQ(pyramid.vertex_count(), kCount + 1);
  EXPECT_EQ(test::violation_of(pyramid), "none");
}

}  // namespace
}  // namespace deliso
