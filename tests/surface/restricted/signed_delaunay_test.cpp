#include "surface/restricted/signed_delaunay.h"

#include <gtest/gtest.h>

#include "delaunay/base/check.h"
#include "delaunay/validate.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

std::vector<std::unique_ptr<Scene>> scenes() {
  std::vector<std::unique_ptr<Scene>> all;
  all.push_back(field_scene("sphere", 16));
  all.push_back(field_scene("linked_tori", 32));
  all.push_back(field_scene("gyroid", 16));
  all.push_back(field_scene("marschner_lobb", 12));
  all.push_back(testing::wave_scene({9, 11, 7}, {1, 2, 4}, 3));
  for (std::uint64_t seed = 0; seed < 4; ++seed) all.push_back(noise_scene({6, 5, 7}, seed));
  return all;
}

TEST(SignedDelaunay, SignsAreThoseOfTheFieldAtCircumcentersFoundInLongDoubles) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    const SignedDelaunay restricted(*scene->isosurface, scene->start());
    const Tetrahedralization& delaunay = restricted.delaunay();
    std::size_t compared = 0;
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      const TetId t(i);
      if (!delaunay.is_live(t) || delaunay.is_ghost(t)) continue;
      const auto [center, condition] = testing::long_circumcenter(testing::corners_of(delaunay, t));
      const double value = scene->isosurface->value(center);
      // Where the center is well known and clearly on one side there is one answer.
      if (condition < 1e-6 || std::abs(value) < 1e-4 * norm(scene->isosurface->gradient(center))) continue;
      EXPECT_EQ(restricted.is_above(t), value > 0);
      ++compared;
    }
    EXPECT_GT(compared, 10u);
  }
}

TEST(SignedDelaunay, GhostsHaveTheSignFarOutOnTheirDualRay) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    const SignedDelaunay restricted(*scene->isosurface, scene->start());
    const Tetrahedralization& delaunay = restricted.delaunay();
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      const TetId t(i);
      if (!delaunay.is_live(t) || !delaunay.is_ghost(t)) continue;
      const auto& v = delaunay.vertices(t);
      const Vec3& a = delaunay.point(v[0]);
      const Vec3 normal = cross(delaunay.point(v[1]) - a, delaunay.point(v[2]) - a);
      const double length = norm(normal);
      // Beyond 1e9 box sizes the clamped point moves no more unless the ray is nearly parallel to a face.
      if (!(length > 1e-6) || std::min({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}) < 1e-6 * length) {
        continue;
      }
      const Vec3 far = a + 1e9 * scene->isosurface->box().diagonal() / length * normal;
      EXPECT_EQ(restricted.is_above(t), scene->isosurface->is_above(far));
    }
  }
}

TEST(SignedDelaunay, RestrictedFacetsMeetEveryEdgeInEvenNumbers) {
  for (const auto& scene : scenes()) {
    SignedDelaunay restricted(*scene->isosurface, scene->start());
    EXPECT_EQ(testing::odd_edges(restricted), 0u) << scene->name;
    // Whatever the signs are.
    Rng rng(5);
    for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
      if (restricted.delaunay().is_live(TetId(i)) && rng.below(3) == 0) restricted.flip_sign(TetId(i));
    }
    EXPECT_EQ(testing::odd_edges(restricted), 0u) << scene->name;
  }
}

TEST(SignedDelaunay, CoplanarPointsGetGuardsAndEveryPointAnUmbrella) {
  const auto scene = field_scene("plane", 12);
  std::vector<Vec3> points = scene->start();
  // Exactly coplanar: an axis-parallel plane through the middle of the box.
  for (Vec3& p : points) p.z = 0.5 * scene->isosurface->box().high.z;
  const SignedDelaunay restricted(*scene->isosurface, points);
  const std::size_t count = restricted.delaunay().vertex_count();
  std::size_t guards = 0;
  for (std::size_t v = 0; v < count; ++v) guards += restricted.is_virtual(VertexId(v)) ? 1 : 0;
  EXPECT_EQ(guards, 2u);
  EXPECT_TRUE(restricted.is_virtual(VertexId(count - 1)));
  EXPECT_TRUE(restricted.is_virtual(VertexId(count - 2)));
  EXPECT_EQ(testing::odd_edges(restricted), 0u);
}

TEST(SignedDelaunay, TheGuardsOfAnAxisParallelPlaneSitOnBothSides) {
  // g = z - 2.5 on a small grid: every surface point has z = 2.5, exactly.
  const Scene scene(
      "ramp", testing::sampled_grid<double>({5, 6, 7}, {1, 1, 1}, [](double, double, double k) { return k; }), 2.5);
  const SignedDelaunay restricted(*scene.isosurface, scene.start());
  const Tetrahedralization& delaunay = restricted.delaunay();
  const std::size_t count = delaunay.vertex_count();
  ASSERT_TRUE(restricted.is_virtual(VertexId(count - 1)));
  ASSERT_TRUE(restricted.is_virtual(VertexId(count - 2)));
  EXPECT_LT((delaunay.point(VertexId(count - 1)).z - 2.5) * (delaunay.point(VertexId(count - 2)).z - 2.5), 0);
  const auto facets = testing::restricted_by_name(restricted);
  for (std::size_t v = 0; v + 2 < count; ++v) {
    const bool on_rim = restricted.is_on_box(VertexId(v));
    EXPECT_EQ(testing::brute_umbrella(restricted, facets, VertexId(v)),
              on_rim ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk)
        << v;
  }
}

TEST(SignedDelaunay, TooFewPointsAreAnInputError) {
  const auto scene = field_scene("sphere", 8);
  EXPECT_THROW(SignedDelaunay(*scene->isosurface, {}), InputError);
  const std::vector<Vec3> one = {{1, 1, 1}};
  EXPECT_THROW(SignedDelaunay(*scene->isosurface, one), InputError);
  const std::vector<Vec3> in_line = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 1, 1}};
  EXPECT_THROW(SignedDelaunay(*scene->isosurface, in_line), InputError);
}

TEST(SignedDelaunay, OnBoxIsExact) {
  const Box3 box{{0, 0, 0}, {3, 4, 5}};
  EXPECT_TRUE(SignedDelaunay::on_box(box, {0, 1, 1}));
  EXPECT_TRUE(SignedDelaunay::on_box(box, {1, 4, 1}));
  EXPECT_TRUE(SignedDelaunay::on_box(box, {1, 1, 5}));
  EXPECT_FALSE(SignedDelaunay::on_box(box, {std::nextafter(0.0, 1), 1, 1}));
  EXPECT_FALSE(SignedDelaunay::on_box(box, {1, std::nextafter(4.0, 0), 1}));
}

TEST(SignedDelaunay, SignsAreTheSameForAnyNumberOfThreads) {
  const auto scene = noise_scene({20, 20, 20}, 5);
  std::vector<Vec3> points;
  for (const EdgeCrossing& c : scene->topology.crossings) points.push_back(crossing_position(scene->grid, c));
  const SignedDelaunay one(*scene->isosurface, points);
  ASSERT_GT(one.delaunay().tet_slots(), 40000u);
  for (const int threads : {2, 3, 5}) {
    EXPECT_EQ(SignedDelaunay(*scene->isosurface, points, threads).signs(), one.signs()) << threads;
  }
}

}  // namespace
}  // namespace deliso
