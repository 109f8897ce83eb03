#include "surface/search/coverage_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/constructions.h"
#include "surface/mesh/triangle_distance.h"

namespace deliso {
namespace {

using Cover = CoverageQuery::Cover;

constexpr double kSide = 100;

Vec3 random_place(Rng& rng) { return {kSide * rng.uniform(), kSide * rng.uniform(), kSide * rng.uniform()}; }
Vec3 unit_step(Rng& rng) { return {2 * rng.uniform() - 1, 2 * rng.uniform() - 1, 2 * rng.uniform() - 1}; }

// Triangles from tiny to large, two of three at the corners of others; sides lead to triangles at random, or nowhere.
SurfaceMesh soup(Rng& rng, std::uint32_t count, double largest) {
  SurfaceMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    const double size = largest * std::pow(0.01, rng.uniform());
    std::uint32_t first = static_cast<std::uint32_t>(mesh.points.size());
    const bool hangs_on = t > 0 && t % 3 != 0;
    if (hangs_on) first = mesh.triangles[static_cast<std::size_t>(rng.uniform() * t)][0];
    const Vec3 at = hangs_on ? mesh.points[first] : random_place(rng);
    if (!hangs_on) mesh.points.push_back(at);
    const auto second = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(at + size * unit_step(rng));
    mesh.points.push_back(at + size * unit_step(rng));
    mesh.triangles.push_back({first, second, second + 1});
    mesh.neighbours.push_back({4 * ((7 * t + 1) % count), kNoSide, 4 * ((t + count - 1) % count)});
  }
  return mesh;
}

// By measuring every triangle.
Cover expected_cover(const SurfaceMesh& mesh, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  double reach = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const double squared = squared_distance_to_triangle(p, a, b, c);
    if (squared >= nearest) continue;
    nearest = squared;
    reach = 0.3 * std::min(circumcircle(a, b, c).radius, std::sqrt(squared_longest_edge(mesh, t)));
  }
  if (nearest < 0.5 * 0.5) return Cover::kClose;
  return nearest < 0.8 * 0.8 || nearest <= reach * reach ? Cover::kFar : Cover::kNone;
}

// Points in a row lie near each other, as those of a surface do that are asked about; now and then they leap.
TEST(CoverageQuery, PointsInARowAreAnsweredLikeEachAlone) {
  for (const double largest : {3.0, 60.0}) {
    Rng rng(static_cast<std::uint64_t>(largest));
    const SurfaceMesh mesh = soup(rng, 80, largest);
    std::vector<Vec3> points;
    while (points.size() < 3000) {
      const std::size_t t = static_cast<std::size_t>(rng.uniform() * 80);
      Vec3 p = points.size() % 2 == 0 ? random_place(rng) : mesh.points[mesh.triangles[t][1]];
      for (double more = 30 * rng.uniform(); more > 0; --more) points.push_back(p += unit_step(rng));
    }
    std::vector<Cover> answers(points.size(), Cover::kNone);
    const CoverageQuery cover(mesh);
    cover.look_at_all(points, answers);
    std::array<int, 3> counts{};
    std::uint32_t guess = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Cover expected = expected_cover(mesh, points[i]);
      EXPECT_EQ(answers[i], expected) << i;
      EXPECT_EQ(cover.look(points[i], guess), expected) << i;
      ++counts[static_cast<std::size_t>(expected)];
    }
    for (const int count : counts) EXPECT_GT(count, 30);
  }
}

// The nearest triangle of a point at the end of a row may be nearly a whole row farther from the row's middle than the
// triangle that is nearest there.
TEST(CoverageQuery, TheNearestTriangleMayBeFarFromTheMiddleOfARow) {
  SurfaceMesh mesh;
  // Large, across the row, two units before its middle; and small, 9.9 units behind it.
  mesh.points = {{-2, -30, -20}, {-2, 30, -20}, {-2, 0, 40}, {9.9, -1, -1}, {9.9, 1, -1}, {9.9, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.neighbours = {{kNoSide, kNoSide, kNoSide}, {kNoSide, kNoSide, kNoSide}};
  std::vector<Vec3> points;
  for (double x = -4; x <= 4; ++x) points.push_back({x, 0, 0});
  std::vector<Cover> answers(points.size(), Cover::kClose);
  CoverageQuery(mesh).look_at_all(points, answers);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(answers[i], expected_cover(mesh, points[i])) << i;
  EXPECT_EQ(answers.back(), Cover::kNone) << "the small one is nearer by a tenth, and does not cover so far";
  EXPECT_EQ(answers[7], Cover::kFar) << "the large one is nearer, and does";
}

TEST(CoverageQuery, AMeshWithoutTrianglesCoversNothing) {
  const SurfaceMesh mesh;
  const CoverageQuery cover(mesh);
  const std::vector<Vec3> points(5, {1, 2, 3});
  std::vector<Cover> answers(points.size(), Cover::kClose);
  cover.look_at_all(points, answers);
  EXPECT_EQ(answers, std::vector<Cover>(points.size(), Cover::kNone));
}

}  // namespace
}  // namespace deliso
