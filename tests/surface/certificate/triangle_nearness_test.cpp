// Which triangles are near the isosurface all over, against complete searches around many of their points.
#include "surface/certificate/triangle_nearness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/certificate/other_side.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// Points of a lattice, beginning with the corners.
std::vector<Vec3> points_of(const std::array<Vec3, 3>& corners, int parts) {
  std::vector<Vec3> points(corners.begin(), corners.end());
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; i + j <= parts; ++j) {
      points.push_back((double(i) * corners[0] + double(j) * corners[1] + double(parts - i - j) * corners[2]) / parts);
    }
  }
  return points;
}

// Triangles whose corners are crossings not far from each other; some lie across tunnels, or between sheets.
TEST(TriangleNearness, IsShownForAllPointsOrRefusedWithAFarPlace) {
  constexpr int kParts = 14;
  Rng rng(4);
  int near = 0, far = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 16), testing::noise_scene({9, 8, 10}, 3, {1, 1, 1.5})}) {
    SCOPED_TRACE(scene->name);
    const Isosurface& isosurface = *scene->isosurface;
    std::vector<Vec3> crossings;
    for (const EdgeCrossing& c : scene->topology.crossings) crossings.push_back(scene->surface().position(c));
    const auto drawn = [&] { return crossings[static_cast<std::size_t>(rng.below(crossings.size()))]; };
    for (int n = 0; n < 400'000; ++n) {
      const double extent = 1 + 2 * rng.uniform();
      const std::array<Vec3, 3> corners = {drawn(), drawn(), drawn()};
      const double longest = std::max(
          {distance(corners[0], corners[1]), distance(corners[1], corners[2]), distance(corners[2], corners[0])});
      if (longest > extent) continue;
      const double most = std::pow(10, -rng.uniform());
      std::vector<Vec3> places;
      const std::int64_t parts = count_far_parts(isosurface, corners, most, 8, &places);
      ASSERT_EQ(parts, static_cast<std::int64_t>(places.size()));
      EXPECT_EQ(count_far_parts(isosurface, corners, most, 1) > 0, parts > 0);
      (parts == 0 ? near : far) += 1;
      for (const Vec3& p : places) EXPECT_FALSE(other_side_within(isosurface, p, 0.75 * most)) << n;
      if (parts > 0) continue;
      for (const Vec3& p : points_of(corners, kParts)) {
        const bool is_beside = std::any_of(corners.begin(), corners.end(),
                                           [&](const Vec3& corner) { return distance(p, corner) <= most; });
        EXPECT_TRUE(is_beside || other_side_within(isosurface, p, 1.01 * most)) << n;
      }
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(far, 200);
}

}  // namespace
}  // namespace deliso
