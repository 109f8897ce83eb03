// The search for the best place of a vertex, where the best one is known.
#include "surface/shape/place_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/mesh/triangle_shape.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

// The isosurface x = 4.3, facing greater x.
struct Plane {
  ScalarGrid grid = testing::sampled({9, 9, 9}, [](const Vec3& p) { return 4.3 - p.x; });
  Isosurface isosurface{grid, 0, {}};
  SearchCounters counters;
  PlaceSearch search{isosurface, counters};

  // A regular hexagon in the plane, counterclockwise seen from greater x.
  static std::vector<RimSegment> hexagon(double radius) {
    const auto corner = [&](int i) {
      const double angle = i * std::numbers::pi / 3;
      return Vec3{4.3, 4 + radius * std::cos(angle), 4 + radius * std::sin(angle)};
    };
    std::vector<RimSegment> rim;
    for (int i = 0; i < 6; ++i) rim.push_back({corner(i), corner(i + 1)});
    return rim;
  }
};

TEST(PlaceSearch, FindsTheMiddleOfAHexagon) {
  for (const bool is_thorough : {false, true}) {
    Plane plane;
    plane.search.set_thorough(is_thorough);
    const std::vector<RimSegment> rim = Plane::hexagon(1.5);
    const Vec3 start{4.3, 4.9, 4.7};
    const std::vector<Vec3> starts = {start};
    const Place place = plane.search.best(rim, starts, {1, 0, 0}, 1);
    EXPECT_NEAR(place.point.x, 4.3, 1e-9);
    EXPECT_GT(place.quality, star_quality(start, rim));
    EXPECT_GT(place.quality, std::sin(55 * std::numbers::pi / 180));  // 60 degrees in the middle
    EXPECT_EQ(place.quality, star_quality(place.point, rim));
  }
}

TEST(PlaceSearch, EndsWhereTheQualityIsEnough) {
  Plane plane;
  const std::vector<RimSegment> rim = Plane::hexagon(1.5);
  const Vec3 start{4.3, 4.9, 4.7};
  const std::vector<Vec3> starts = {start};
  const double enough = 0.9 * star_quality(start, rim);
  EXPECT_EQ(plane.search.best(rim, starts, {1, 0, 0}, enough).point, start);
}

TEST(PlaceSearch, StaysOnTheBoundaryCurve) {
  Plane plane;
  const Vec3 begin{4.3, 2, 0}, end{4.3, 6, 0};  // in the face z = 0
  const std::vector<RimSegment> rim = {{{4.3, 6, 0}, {4.3, 4, 2}}, {{4.3, 4, 2}, {4.3, 2, 0}}};
  const std::vector<Vec3> starts = {{4.3, 2.4, 0}};
  const unsigned faces = faces_at(plane.isosurface.box(), begin);
  EXPECT_EQ(faces, 1u << 4);
  const Place place = plane.search.best_on_curve(rim, starts, {begin, end, outward_normal(faces)}, 1);
  EXPECT_EQ(place.point.z, 0);
  EXPECT_NEAR(place.point.x, 4.3, 1e-9);
  EXPECT_NEAR(place.point.y, 4, 0.1);
  EXPECT_GT(place.quality, star_quality(starts.front(), rim));
}

TEST(PlaceSearch, NamesTheFacesOfThePointsOfABox) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(faces_at(box, {0.5, 1, 1}), 0u);
  EXPECT_EQ(faces_at(box, {0, 2, 1}), (1u << 0) | (1u << 3));
  EXPECT_EQ(outward_normal(1u << 3), (Vec3{0, 1, 0}));
  EXPECT_EQ(outward_normal(1u << 4), (Vec3{0, 0, -1}));
}

TEST(TriangleShape, IsTheSineOfTheSmallestAngle) {
  EXPECT_NEAR(sine_of_least_angle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), std::sqrt(0.75), 1e-15);
  for (const double degrees : {1e-9, 0.1, 10.0, 59.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(sine_of_least_angle({0, 0, 0}, {2, 0, 0}, {2 * std::cos(angle), 2 * std::sin(angle), 0}),
                std::sin(angle), 1e-15);
  }
  EXPECT_EQ(sine_of_least_angle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0);
  EXPECT_EQ(sine_of_least_angle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), 0);
}

}  // namespace
}  // namespace deliso
