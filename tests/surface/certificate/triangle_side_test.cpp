// The side of whole triangles, against the sides of many of their points.
#include "surface/certificate/triangle_side.h"

#include <gtest/gtest.h>

#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

constexpr int kParts = 24;

// What the points of a lattice say: nothing, where they disagree. `least`: the least of their values' sizes.
std::optional<bool> side_of_points(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double& least) {
  least = std::abs(isosurface.value(corners[0]));
  const bool is_above = isosurface.is_above(corners[0]);
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      const Vec3 p = (double(i) * corners[0] + double(j) * corners[1] + double(kParts - i - j) * corners[2]) / kParts;
      if (isosurface.is_above(p) != is_above) return std::nullopt;
      least = std::min(least, std::abs(isosurface.value(p)));
    }
  }
  return is_above;
}

// Triangles within one cell and over many, some beyond the box.
TEST(TriangleSide, IsThatOfAllPointsAndMostlyKnown) {
  Rng rng(8);
  int one_sided = 0, known = 0, clear = 0, known_of_clear = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 16), testing::noise_scene({9, 8, 10}, 3, {1, 2, 1.5})}) {
    SCOPED_TRACE(scene->name);
    const Isosurface& isosurface = *scene->isosurface;
    const Vec3 size = isosurface.box().size();
    for (int n = 0; n < 4000; ++n) {
      const double extent = std::pow(10, -2 * rng.uniform()) * 3;
      Vec3 middle;
      for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (1.2 * rng.uniform() - 0.1) * size[axis];
      std::array<Vec3, 3> corners;
      for (Vec3& p : corners) {
        p = middle + extent * Vec3{rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5};
      }
      double least = 0;
      const std::optional<bool> expected = side_of_points(isosurface, corners, least);
      const std::optional<bool> side = side_of_triangle(isosurface, corners);
      ASSERT_TRUE(!side || side == expected) << n;
      if (!expected) continue;
      ++one_sided;
      known += side ? 1 : 0;
      // A cubic is near its coefficients on a small triangle.
      if (extent > 0.3 || least < 0.02 * norm(isosurface.gradient(middle))) continue;
      ++clear;
      known_of_clear += side ? 1 : 0;
    }
  }
  EXPECT_GT(one_sided, 3000);
  EXPECT_GT(known, 0.95 * one_sided);
  EXPECT_GT(clear, 1000);
  EXPECT_GT(known_of_clear, 0.99 * clear);
}

}  // namespace
}  // namespace deliso
