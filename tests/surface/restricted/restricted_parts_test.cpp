// Parts of a restricted Delaunay triangulation, as threads use them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

#include "surface/restricted/restricted_delaunay.h"
#include "tests/support/hit_tables.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::expect_consistent;
using testing::expect_right_quick_umbrellas;
using testing::field_scene;
using testing::hit_table;
using testing::HitTable;
using testing::missing_hits;
using testing::noise_scene;

TEST(RestrictedParts, ThatHaveJoinedLeaveWhatAFreshComputationFinds) {
  std::size_t inserted = 0, blocked = 0;
  for (const auto& scene : {field_scene("torus", 24), field_scene("gyroid", 14), noise_scene({6, 7, 6}, 4)}) {
    SCOPED_TRACE(scene->name);
    Rng rng(21);
    SearchCounters counters;
    const std::vector<Vec3> rays = random_ray_points(*scene->isosurface, 400, rng, counters);
    RestrictedDelaunay whole(*scene->isosurface, scene->start());
    for (const Vec3& p : std::span(rays).first(rays.size() / 2)) whole.insert(p, TetId(std::size_t{0}), 0.01);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double plane = rays[axis][axis];
      const std::array<Slab, 2> slabs = {Slab{axis, -INFINITY, plane}, Slab{axis, plane, INFINITY}};
      const auto parts = whole.parts(slabs, 30 + 10 * axis);
      ASSERT_EQ(parts.size(), 2u);
      for (const Vec3& p : std::span(rays).subspan(rays.size() / 2)) {
        RestrictedDelaunay& part = *parts[p[axis] < plane ? 0 : 1];
        const TetId start = part.locate(p, p, part.delaunay().incident_tet(VertexId(std::size_t{0})));
        if (!part.has_room() || start.index() >= part.delaunay().tet_slots()) continue;
        const auto outcome = part.insert(p, start, 0.01);
        inserted += outcome == RestrictedDelaunay::Outcome::kInserted ? 1 : 0;
        blocked += outcome == RestrictedDelaunay::Outcome::kBlocked ? 1 : 0;
      }
      whole.join(parts);
      const RestrictedDelaunay fresh(*scene->isosurface, whole.delaunay().points());
      ASSERT_EQ(testing::signs_by_name(whole), testing::signs_by_name(fresh));
      expect_consistent(whole);
      expect_right_quick_umbrellas(whole);
      const HitTable ours = hit_table(whole), theirs = hit_table(fresh);
      EXPECT_EQ(missing_hits(ours, theirs), 0u);
      EXPECT_EQ(missing_hits(theirs, ours), 0u);
      ASSERT_FALSE(::testing::Test::HasFailure());
    }
  }
  EXPECT_GT(inserted, 300u);
  EXPECT_GT(blocked, 30u);
}

}  // namespace
}  // namespace deliso
