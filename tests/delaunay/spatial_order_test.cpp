#include "delaunay/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "delaunay/base/rng.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

using test::Points;

double path_length(const Points& points, std::span<const std::uint32_t> order) {
  double length = 0;
  for (std::size_t i = 1; i < order.size(); ++i) length += distance(points[order[i - 1]], points[order[i]]);
  return length;
}

TEST(SpatialOrder, IsAPermutation) {
  Rng rng(1);
  auto kinds = test::all_kinds(2000, rng);
  kinds.push_back({"all equal", Points(500, Vec3{1, 2, 3})});
  kinds.push_back({"none", {}});
  kinds.push_back({"one", {{0, 0, 0}}});
  for (const auto& [name, points] : kinds) {
    std::vector<std::uint32_t> order = spatial_order(points);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all) << name;
  }
}

void expect_equal_points_together(const Points& points) {
  const std::vector<std::uint32_t> order = spatial_order(points);
  std::map<std::array<double, 3>, std::size_t> last;  // position in the order
  for (std::size_t at = 0; at < order.size(); ++at) {
    const Vec3& p = points[order[at]];
    const auto [found, is_new] = last.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, at);
    if (is_new) continue;
    ASSERT_EQ(std::exchange(found->second, at), at - 1);
    ASSERT_LT(order[at - 1], order[at]);
  }
}

TEST(SpatialOrder, EqualPointsFollowEachOtherByIndex) {
  Rng rng(2);
  Points points = test::duplicates(3000, rng);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] = scaled(points[i], {1, -1, 1});  // zeros of both signs
  expect_equal_points_together(points);
  expect_equal_points_together(test::twice_in_shared_cells(3000, rng));
}

// A curve that fills space visits n random points in a path of about 0.92 n^(2/3); a random order needs 0.66 n.
TEST(SpatialOrder, ConsecutivePointsAreClose) {
  Rng rng(3);
  const Points points = test::random_points(50000, rng);
  EXPECT_LT(path_length(points, spatial_order(points)), 1.7 * std::pow(50000.0, 2.0 / 3.0));
}

// Clusters far smaller than a cell of the curve's grid are refined: the path within is as short as in a large box.
TEST(SpatialOrder, ConsecutivePointsAreCloseInTinyClusters) {
  Rng rng(4);
  Points points = test::random_points(20000, rng);
  for (Vec3& p : points) p = 1e-7 * p;
  points.push_back({1, 1, 1});
  const std::vector<std::uint32_t> order = spatial_order(points);
  std::vector<std::uint32_t> cluster;
  std::copy_if(order.begin(), order.end(), std::back_inserter(cluster), [](std::uint32_t i) { return i < 20000; });
  EXPECT_LT(path_length(points, cluster), 4e-7 * std::pow(20000.0, 2.0 / 3.0));
}

// All rounds but the last make up an eighth of the points, 5000 more or less, spread all over the cube.
TEST(SpatialOrder, EarlyRoundsAreRandomSamples) {
  Rng rng(5);
  const Points points = test::random_points(40000, rng);
  const std::vector<std::uint32_t> order = spatial_order(points);
  std::array<int, 8> octants{};
  for (std::size_t i = 0; i < 4900; ++i) {
    const Vec3& p = points[order[i]];
    ++octants[(p.x > 0.5) + 2 * (p.y > 0.5) + 4 * (p.z > 0.5)];
  }
  for (const int count : octants) {
    EXPECT_GT(count, 400);
    EXPECT_LT(count, 750);
  }
}

}  // namespace
}  // namespace deliso
