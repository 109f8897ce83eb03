#include "surface/intersection/self_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "delaunay/predicates.h"
#include "surface/base/parallel_blocks.h"
#include "surface/search/box_tree.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/random_boxes.h"

namespace deliso {
namespace {

using testing::have_common_point;
using testing::random_boxes;

TEST(BoxTree, FindsTheNearestAndWhatMeetsABoxLikeBruteForce) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    const std::vector<Box3> boxes = random_boxes(rng, rng.below(120), 0.2);
    const BoxTree tree(boxes);

    const Box3 around = random_boxes(rng, 1, 0.6)[0];
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (have_common_point(boxes[i], around)) expected.push_back(i);
    }
    tree.for_each_meeting(around, [&](std::uint32_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << "seed " << seed;

    const Vec3 p{rng.uniform(-1, 2), rng.uniform(-1, 2), rng.uniform(-1, 2)};
    const auto measure = [&](std::uint32_t i) { return squared_distance(p, 0.5 * (boxes[i].low + boxes[i].high)); };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) nearest = std::min(nearest, measure(i));
    EXPECT_EQ(tree.nearest(p, std::numeric_limits<double>::infinity(), measure).second, nearest) << "seed " << seed;
    EXPECT_EQ(tree.nearest(p, nearest, measure).first, BoxTree::kNone) << "seed " << seed;
  }
}

// Of so many boxes, a whole number of blocks or not, that threads share the work.
TEST(BoxTree, ThreadsMakeTheSameTreeOfManyBoxes) {
  for (const std::size_t count : {2 * kBlockSize, 2 * kBlockSize + 5, 3 * kBlockSize - 1}) {
    Rng rng(count);
    const std::vector<Box3> boxes = random_boxes(rng, count, 0.02);
    const BoxTree one(boxes), several(boxes, 3);
    for (int i = 0; i < 5; ++i) {
      const Box3 around = random_boxes(rng, 1, 0.1)[0];
      std::vector<std::uint32_t> expected, found, found_by_one;
      for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        if (have_common_point(boxes[b], around)) expected.push_back(b);
      }
      several.for_each_meeting(around, [&](std::uint32_t b) { found.push_back(b); });
      one.for_each_meeting(around, [&](std::uint32_t b) { found_by_one.push_back(b); });
      EXPECT_EQ(found, found_by_one) << count;  // in the same order
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << count;
    }
  }
}

TEST(BoxTree, OfEquallyNearThingsTheFirstIsFound) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    // Few places and measures, so that there are many equals.
    std::vector<Box3> boxes(10 + rng.below(150));
    for (Box3& box : boxes) {
      const Vec3 p{std::floor(rng.uniform(0, 3)), std::floor(rng.uniform(0, 3)), 0};
      box = {p, p};
    }
    const BoxTree tree(boxes);
    const Vec3 p{1.5, 1.5, 0.5};
    const auto measure = [&](std::uint32_t i) { return squared_distance(p, boxes[i].low); };
    std::uint32_t first = 0;
    for (std::uint32_t i = 1; i < boxes.size(); ++i) {
      if (measure(i) < measure(first)) first = i;
    }
    EXPECT_EQ(tree.nearest(p, 100, measure).first, first) << "seed " << seed;
  }
}

TEST(SelfIntersections, AllPairsAgreeWithTestingEveryPair) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    TriangleMesh mesh = testing::random_soup(rng, 40, 60);
    std::int64_t crossing = 0, touching = 0, flat = 0;
    std::vector<TrianglePair> pairs;
    const auto has_area = [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return !collinear(mesh.points[a], mesh.points[b], mesh.points[c]);
    };
    for (std::uint32_t s = 0; s < mesh.triangles.size(); ++s) {
      if (!has_area(s)) {
        ++flat;
        continue;
      }
      for (std::uint32_t t = s + 1; t < mesh.triangles.size(); ++t) {
        if (!has_area(t)) continue;
        const TriangleContact c = triangle_contact(mesh.points, mesh.triangles[s], mesh.triangles[t]);
        touching += c == TriangleContact::kTouching ? 1 : 0;
        crossing += c == TriangleContact::kCrossing ? 1 : 0;
        if (c == TriangleContact::kCrossing) pairs.push_back({s, t, c, {}});
      }
    }
    const int threads = seed % 2 == 0 ? 3 : 1;
    const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, 7, threads);
    EXPECT_EQ(found.crossing_pairs, crossing) << "seed " << seed;
    EXPECT_EQ(found.touching_pairs, touching) << "seed " << seed;
    EXPECT_EQ(found.zero_area_triangles, flat) << "seed " << seed;
    ASSERT_EQ(found.crossing.size(), std::min<std::size_t>(7, pairs.size()));
    for (std::size_t i = 0; i < found.crossing.size(); ++i) {
      EXPECT_EQ(found.crossing[i].first, pairs[i].first) << "seed " << seed;
      EXPECT_EQ(found.crossing[i].second, pairs[i].second) << "seed " << seed;
    }
  }
}

// Coordinates whose products overflow, or vanish: what meets does not depend on the unit of length.
TEST(SelfIntersections, DoNotDependOnTheScale) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rng rng(seed);
    const TriangleMesh mesh = testing::random_soup(rng, 40, 60);
    const SelfIntersections expected = self_intersections(mesh);
    ASSERT_GT(expected.crossing_pairs, 0);
    for (const int exponent : {-900, -300, 200, 400, 1000}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", exponent " + std::to_string(exponent));
      const double scale = std::ldexp(1.0, exponent);
      TriangleMesh scaled_mesh = mesh;
      for (Vec3& p : scaled_mesh.points) p = scale * p;
      const SelfIntersections found = self_intersections(scaled_mesh);
      EXPECT_EQ(found.crossing_pairs, expected.crossing_pairs);
      EXPECT_EQ(found.touching_pairs, expected.touching_pairs);
      EXPECT_EQ(found.zero_area_triangles, expected.zero_area_triangles);
      for (std::size_t i = 0; i < expected.crossing.size(); ++i) {
        EXPECT_EQ(found.crossing[i].position, scale * expected.crossing[i].position);
      }
    }
  }
}

// Everything was scaled until the far point fitted, and what was left of the triangles crossed.
TEST(SelfIntersections, DoNotDependOnPointsOfNoTriangle) {
  const TriangleMesh mesh = testing::sphere_mesh(2);
  for (const double far : {1e60, 1e150, 1e200, 1e300}) {
    TriangleMesh with_far = mesh;
    with_far.points.push_back({far, 0, -far});
    const SelfIntersections found = self_intersections(with_far);
    EXPECT_EQ(found.crossing_pairs + found.touching_pairs + found.zero_area_triangles, 0) << far;
  }
}

TEST(SelfIntersections, OfMarkedTrianglesAreAllPairsWithOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const TriangleMesh mesh = testing::random_soup(rng, 40, 60);
    std::vector<std::uint8_t> marks(mesh.triangles.size());
    for (std::uint8_t& mark : marks) mark = rng.below(4) == 0 ? 1 : 0;
    constexpr std::size_t kAll = 10000;
    const SelfIntersections all = self_intersections(mesh, kAll);
    const SelfIntersections found = self_intersections_of(marks, mesh, kAll);
    for (const auto kind : {&SelfIntersections::crossing, &SelfIntersections::touching}) {
      std::vector<TrianglePair> expected = all.*kind;
      std::erase_if(expected, [&](const TrianglePair& p) { return marks[p.first] == 0 && marks[p.second] == 0; });
      ASSERT_EQ((found.*kind).size(), expected.size()) << "seed " << seed;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ((found.*kind)[i].first, expected[i].first) << "seed " << seed;
        EXPECT_EQ((found.*kind)[i].second, expected[i].second) << "seed " << seed;
      }
    }
    EXPECT_EQ(found.crossing_pairs, static_cast<std::int64_t>(found.crossing.size()));
    EXPECT_EQ(found.touching_pairs, static_cast<std::int64_t>(found.touching.size()));
  }
}

TEST(SelfIntersections, CleanMeshesHaveNoneAndOverlappingSpheresHaveSome) {
  const TriangleMesh sphere = testing::sphere_mesh(4);
  EXPECT_EQ(self_intersections(sphere).crossing_pairs + self_intersections(sphere).touching_pairs, 0);
  EXPECT_EQ(self_intersections(testing::torus_mesh(40, 30)).crossing_pairs, 0);
  EXPECT_EQ(self_intersections({}).crossing_pairs, 0);

  // Two spheres that cross along a circle, and two that touch at one octahedron corner.
  const SelfIntersections crossing =
      self_intersections(testing::disjoint_union(sphere, testing::sphere_mesh(4, 1, {0.7, 0.3, 0.1})));
  EXPECT_GT(crossing.crossing_pairs, 50);
  for (const TrianglePair& pair : crossing.crossing) EXPECT_LT(pair.first, pair.second);
  const SelfIntersections touching =
      self_intersections(testing::disjoint_union(sphere, testing::sphere_mesh(4, 1, {2, 0, 0})));
  EXPECT_EQ(touching.crossing_pairs, 0);
  EXPECT_EQ(touching.touching_pairs, 16);  // four triangles at the corner of either
}

}  // namespace
}  // namespace deliso
