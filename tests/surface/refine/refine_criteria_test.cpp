// The criteria of stage 2: triangles meet them afterwards, whichever are chosen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/refine/refine.h"
#include "tests/support/refine_runs.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::fine_options;
using testing::run;
using testing::stage1_mesh;

TEST(Refine, TrianglesMeetTheCriteriaWhereNothingWasRefused) {
  for (const char* name : {"sphere", "torus"}) {
    SCOPED_TRACE(name);
    const auto scene = field_scene(name, 24);
    SurfaceMesh mesh = stage1_mesh(*scene);
    RefineOptions options = fine_options();
    options.max_distance = 0.05;
    std::vector<SurfaceDelaunayBall> balls;
    const RefineStats stats = run(mesh, *scene, options, &balls);
    const auto refused = std::accumulate(stats.refused.begin(), stats.refused.end(), std::int64_t{0});
    EXPECT_GT(stats.insertions, 100);
    EXPECT_LE(refused, stats.insertions / 50);
    std::int64_t failing = 0;
    std::int64_t small = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t];
      const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
      const Circumcircle circle = circumcircle(a, b, c);
      const double h = distance(circle.center, balls[t].center);
      const double shortest = std::min({distance(a, b), distance(b, c), distance(c, a)});
      const double pole = (mesh.pole_heights[v[0]] + mesh.pole_heights[v[1]] + mesh.pole_heights[v[2]]) / 3;
      constexpr double kSlack = 1 + 1e-9;
      const bool fails = h > options.epsilon1 * circle.radius * kSlack ||
                         circle.radius > options.epsilon2 * pole * kSlack ||
                         circle.radius > options.rho * shortest * kSlack || h > options.max_distance * kSlack;
      if (circle.radius > options.r_min) failing += fails ? 1 : 0;
      if (circle.radius <= options.r_min) small += fails ? 1 : 0;
    }
    EXPECT_LE(failing, refused);
    EXPECT_EQ(small, stats.stopped_at_r_min);
  }
}

TEST(Refine, FlatTrianglesBecomeRoundOnes) {
  const auto scene = field_scene("torus", 32);
  SurfaceMesh mesh = stage1_mesh(*scene);
  run(mesh, *scene, fine_options());
  std::size_t thin = 0;
  for (const auto& v : mesh.triangles) {
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const double shortest = std::min({distance(a, b), distance(b, c), distance(c, a)});
    thin += circumcircle(a, b, c).radius > 2.001 * shortest ? 1 : 0;
  }
  EXPECT_LE(thin, mesh.triangles.size() / 200);
}

TEST(Refine, ANewVertexTakesTheMeanOrTheNearestPoleHeight) {
  const auto scene = field_scene("torus", 16);
  for (const NewPole rule : {NewPole::kMean, NewPole::kNearest}) {
    SurfaceMesh mesh = stage1_mesh(*scene);
    const std::size_t first_new = mesh.points.size();
    std::vector<double> known = mesh.pole_heights;
    RefineOptions options = fine_options();
    options.new_pole = rule;
    run(mesh, *scene, options);
    ASSERT_GT(mesh.points.size(), first_new + 10);
    // Copies make no new heights, means of different ones do.
    std::sort(known.begin(), known.end());
    std::size_t copies = 0;
    for (std::size_t v = first_new; v < mesh.points.size(); ++v) {
      if (std::binary_search(known.begin(), known.end(), mesh.pole_heights[v])) ++copies;
    }
    if (rule == NewPole::kNearest) {
      EXPECT_EQ(copies, mesh.points.size() - first_new);
    } else {
      EXPECT_EQ(copies, 0u);
    }
  }
}

TEST(Refine, Criterion2BoundsTheLengthItIsGiven) {
  const auto scene = field_scene("torus", 16);
  for (const Criterion2 criterion : {Criterion2::kCircumradius, Criterion2::kShortestEdge}) {
    SurfaceMesh mesh = stage1_mesh(*scene);
    RefineOptions options;
    options.r_min = 0.05;
    options.epsilon1 = 1e9;
    options.rho = 1e9;
    options.epsilon2 = 0.4;
    options.criterion2 = criterion;
    const RefineStats stats = run(mesh, *scene, options);
    EXPECT_EQ(std::accumulate(stats.refused.begin(), stats.refused.end(), std::int64_t{0}), 0);
    double largest = 0;
    for (const auto& triangle : mesh.triangles) {
      const Vec3 &a = mesh.points[triangle[0]], &b = mesh.points[triangle[1]], &c = mesh.points[triangle[2]];
      double pole = 0;
      for (const std::uint32_t v : triangle) pole += mesh.pole_heights[v] / 3;
      const double shortest = std::min({distance(a, b), distance(b, c), distance(c, a)});
      const double size = criterion == Criterion2::kCircumradius ? circumcircle(a, b, c).radius : shortest;
      largest = std::max(largest, size / pole);
    }
    EXPECT_LE(largest, 0.4 * (1 + 1e-9));
    EXPECT_GT(largest, 0.2);
  }
}

}  // namespace
}  // namespace deliso
