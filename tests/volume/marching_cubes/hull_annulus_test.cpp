#include "volume/marching_cubes/hull_annulus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/predicates.h"
#include "surface/intersection/exact_tests.h"
#include "tests/support/cell_mesh_check.h"
#include "tests/support/topology_mesh_check.h"

namespace deliso {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Polygon = std::vector<std::uint32_t>;

// A manifold annulus whose boundary is the two polygons, without contacts.
void expect_annulus(const std::vector<Vec3>& points, const std::vector<Corners>& triangles, const Polygon& first,
                    const Polygon& second) {
  const test::MeshFacts facts = test::mesh_facts(triangles);
  EXPECT_EQ(facts.defect, "");
  EXPECT_EQ(facts.components, (std::vector<ComponentTopology>{{0, 2}}));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (const Polygon* polygon : {&first, &second}) {
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      expected.emplace_back((*polygon)[i], (*polygon)[(i + 1) % polygon->size()]);
    }
  }
  auto boundary = facts.boundary;
  std::sort(boundary.begin(), boundary.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(boundary, expected);
  EXPECT_EQ(test::contacts(points, triangles), 0);
}

// Facets of four corners, and eight triangles between two of them.
TEST(HullAnnulus, OfACubeIsFourOfItsFaces) {
  std::vector<Vec3> points;
  for (int c = 0; c < 8; ++c) points.push_back({double(c & 1), double(c >> 1 & 1), double(c >> 2)});
  const Polygon bottom{0, 1, 3, 2}, bottom_back{2, 3, 1, 0}, top{4, 6, 7, 5}, top_back{5, 7, 6, 4};
  EXPECT_EQ(hull_annulus(points, bottom, top, kExactTests).size(), 8u);
  expect_annulus(points, hull_annulus(points, bottom, top, kExactTests), bottom, top);
  expect_annulus(points, hull_annulus(points, bottom_back, top_back, kExactTests), bottom_back, top_back);
  EXPECT_TRUE(hull_annulus(points, bottom, top_back, kExactTests).empty()) << "on different sides";
}

TEST(HullAnnulus, LiesBetweenTwoFacets) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    std::vector<Vec3> points(7 + rng.below(6));
    for (Vec3& p : points) {
      p = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
      p = p / norm(p);
    }
    // The facets counterclockwise seen from inside, so that the rest runs along them the other way.
    std::vector<Polygon> facets;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      for (std::uint32_t j = 0; j < points.size(); ++j) {
        for (std::uint32_t k = 0; k < points.size(); ++k) {
          if (i >= std::min(j, k) || j == k) continue;
          const auto is_inside = [&](const Vec3& p) { return orient3d(points[i], points[j], points[k], p) >= 0; };
          if (std::all_of(points.begin(), points.end(), is_inside)) facets.push_back({i, k, j});
        }
      }
    }
    const Polygon& first = facets[0];
    for (const Polygon& second : facets) {
      if (std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end()) continue;
      ++tried;
      // The inner side runs along both facets' own direction, the outer one against it.
      const Polygon first_back(first.rbegin(), first.rend()), second_back(second.rbegin(), second.rend());
      const auto annulus = hull_annulus(points, first, second, kExactTests);
      EXPECT_EQ(annulus.size(), 2 * points.size() - 6) << "seed " << seed;
      expect_annulus(points, annulus, first, second);
      expect_annulus(points, hull_annulus(points, first_back, second_back, kExactTests), first_back, second_back);
      EXPECT_TRUE(hull_annulus(points, first, second_back, kExactTests).empty()) << "seed " << seed;
    }
  }
  EXPECT_GT(tried, 200);
}

}  // namespace
}  // namespace deliso
