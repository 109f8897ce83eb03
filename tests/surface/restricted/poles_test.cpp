#include "surface/restricted/poles.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;

// The farthest Voronoi vertex of q on each side; infinite where the cell is, unless q lies on the box. Not reliable
// when some tetrahedron is too flat.
std::array<double, 2> brute_poles(const SignedDelaunay& restricted, VertexId q, bool& reliable) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  std::array<double, 2> farthest{0, 0};
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t)) continue;
    const auto& v = delaunay.vertices(t);
    if (std::find(v.begin(), v.end(), q) == v.end()) continue;
    double& side = farthest[restricted.is_above(t) ? 1 : 0];
    if (delaunay.is_ghost(t)) {
      if (!restricted.is_on_box(q)) side = std::numeric_limits<double>::infinity();
      continue;
    }
    const auto [center, condition] = testing::long_circumcenter(testing::corners_of(delaunay, t));
    reliable &= condition > 1e-8;
    side = std::max(side, distance(center, delaunay.point(q)));
  }
  return farthest;
}

TEST(Poles, HeightsAreTheSmallerOfTheFarthestVoronoiVerticesOfTheTwoSides) {
  for (const auto& scene : {field_scene("torus", 16), field_scene("gyroid", 12), noise_scene({4, 5, 4}, 2)}) {
    SCOPED_TRACE(scene->name);
    const SignedDelaunay restricted(*scene->isosurface, scene->start());
    const std::vector<double> heights = compute_poles(restricted);
    ASSERT_EQ(heights.size(), restricted.delaunay().vertex_count());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      bool reliable = true;
      const auto [below, above] = brute_poles(restricted, VertexId(i), reliable);
      if (!reliable) continue;
      double expected = scene->isosurface->box().diagonal();
      if (below > 0) expected = std::min(expected, below);
      if (above > 0) expected = std::min(expected, above);
      EXPECT_NEAR(heights[i], expected, 1e-6 * expected) << i;
      ++compared;
    }
    EXPECT_GT(compared, 10u);
  }
}

TEST(Poles, TheFartherPoleAndTheMeanOfBothTakeTheOtherSideIntoAccount) {
  for (const auto& scene : {field_scene("torus", 16), field_scene("gyroid", 12)}) {
    SCOPED_TRACE(scene->name);
    const SignedDelaunay restricted(*scene->isosurface, scene->start());
    const std::vector<double> nearer = compute_poles(restricted, PoleHeight::kNearer);
    const std::vector<double> farther = compute_poles(restricted, PoleHeight::kFarther);
    const std::vector<double> mean = compute_poles(restricted, PoleHeight::kMean);
    EXPECT_EQ(nearer, compute_poles(restricted));
    const double most = scene->isosurface->box().diagonal();
    std::size_t compared = 0;
    for (std::size_t i = 0; i < nearer.size(); ++i) {
      EXPECT_LE(nearer[i], mean[i]);
      EXPECT_LE(mean[i], farther[i]);
      bool reliable = true;
      const auto [below, above] = brute_poles(restricted, VertexId(i), reliable);
      if (!reliable || !(below > 0) || !(above > 0)) continue;
      const double expected = std::min(most, std::max(below, above));
      EXPECT_NEAR(farther[i], expected, 1e-6 * expected) << i;
      EXPECT_NEAR(mean[i], (nearer[i] + farther[i]) / 2, 1e-12 * most) << i;
      ++compared;
    }
    EXPECT_GT(compared, 10u);
  }
}

// The medial axis of a sphere is its center. Samples denser than voxels would see the creases of the interpolant.
TEST(Poles, OnASphereTheHeightIsTheRadius) {
  const auto scene = field_scene("sphere", 40);
  Rng rng(1);
  SearchCounters counters;
  const SignedDelaunay restricted(*scene->isosurface, random_ray_points(*scene->isosurface, 150, rng, counters));
  const double radius = 0.7 * 39 / 2;
  const std::vector<double> heights = compute_poles(restricted);
  const auto far =
      std::count_if(heights.begin(), heights.end(), [&](double h) { return std::abs(h - radius) > 0.1 * radius; });
  EXPECT_LE(far, static_cast<std::int64_t>(heights.size() / 50));
}

TEST(Poles, OnATorusTheHeightIsMostlyTheTubeRadius) {
  const auto scene = field_scene("torus", 40);
  Rng rng(1);
  SearchCounters counters;
  const SignedDelaunay restricted(*scene->isosurface, random_ray_points(*scene->isosurface, 600, rng, counters));
  const double radius = 0.3 * 39 / 2;
  const std::vector<double> heights = compute_poles(restricted);
  const auto far =
      std::count_if(heights.begin(), heights.end(), [&](double h) { return std::abs(h - radius) > 0.15 * radius; });
  EXPECT_LE(far, static_cast<std::int64_t>(heights.size() / 20));
  EXPECT_LT(*std::max_element(heights.begin(), heights.end()), 1.2 * radius);
}

}  // namespace
}  // namespace deliso
