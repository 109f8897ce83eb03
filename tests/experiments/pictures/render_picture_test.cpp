// Pictures judged by geometry: silhouettes, sides, lights and lines are where they must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "delaunay/base/rng.h"
#include "experiments/pictures/camera.h"
#include "experiments/pictures/isosurface_shape.h"
#include "experiments/pictures/lighting.h"
#include "experiments/pictures/mesh_shape.h"
#include "experiments/pictures/picture.h"
#include "tests/support/sphere_pictures.h"
#include "volume/fields/field_slices.h"

namespace deliso::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double linear(std::uint8_t byte) {
  const double value = byte / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

TEST(Camera, ProjectsThePointsOfItsRaysToWhereTheyStart) {
  Rng rng(7);
  const std::vector<Vec3> framed = {{0, 0, 0}, {3, 1, 2}, {-1, 2, 0.5}};
  for (int n = 0; n < 200; ++n) {
    View view;
    view.azimuth = rng.uniform(-360, 360);
    view.elevation = rng.uniform(-90, 90);
    view.zoom = rng.uniform(0.1, 10);
    view.field_of_view = n % 2 == 0 ? 0 : rng.uniform(1, 120);
    if (n % 3 == 0) view.look_at = Vec3{1, 2, 3};
    const Camera camera(view, framed, 320, 200);
    const double x = rng.uniform(0, 320);
    const double y = rng.uniform(0, 200);
    const auto seen = camera.project(camera.ray(x, y).at(rng.uniform(0.1, 30)));
    ASSERT_TRUE(seen) << n;
    EXPECT_NEAR((*seen)[0], x, 1e-6) << n;
    EXPECT_NEAR((*seen)[1], y, 1e-6) << n;
  }
}

TEST(Camera, FramedPointsFillThePictureAndZIsUp) {
  Rng rng(8);
  for (int n = 0; n < 100; ++n) {
    std::vector<Vec3> framed;
    for (int i = 0; i < 6; ++i) framed.push_back({rng.uniform(-5, 5), rng.uniform(0, 9), rng.uniform(-1, 1)});
    View view;
    view.azimuth = rng.uniform(-180, 180);
    view.elevation = rng.uniform(-80, 80);
    view.field_of_view = n % 2 == 0 ? 0 : 50;
    const Camera camera(view, framed, 300, 200);
    double nearest_side = kInfinity;
    for (const Vec3& p : framed) {
      const auto seen = camera.project(p);
      ASSERT_TRUE(seen);
      nearest_side = std::min({nearest_side, (*seen)[0], (*seen)[1], 300 - (*seen)[0], 200 - (*seen)[1]});
    }
    EXPECT_GE(nearest_side, 7.9) << n;  // 4 % of 200
    EXPECT_LE(nearest_side, 12.1) << n;
    if (view.field_of_view > 0) continue;
    EXPECT_LT((*camera.project({0, 0, 1}))[1], (*camera.project({0, 0, 0}))[1]) << n;
  }
}

TEST(Picture, SilhouetteOfASphereHasItsArea) {
  const ScalarGrid grid = sphere_grid();
  const IsosurfaceShape shape(grid, 0);
  const Camera camera(View(), shape.outermost_points(), 160, 120);
  Image image(160, 120);
  PictureOptions options;
  draw(shape, grid.box(), camera, options, 0, image);
  // The disk stays dark enough everywhere to tell its share of a pixel from white roughly: count samples instead.
  int seen = 0;
  constexpr int kFine = 4;
  for (int y = 0; y < 120 * kFine; ++y) {
    for (int x = 0; x < 160 * kFine; ++x) {
      const Line ray = camera.ray((x + 0.5) / kFine, (y + 0.5) / kFine);
      const bool hit = shape.first_hit(ray, 0, 1000).has_value();
      seen += hit ? 1 : 0;
      if (x % kFine != 1 || y % kFine != 1 || !hit) continue;
      EXPECT_LT(image.pixel(x / kFine, y / kFine)[2], 255) << x << ' ' << y;  // what a ray sees is drawn
    }
  }
  const double pixel = camera.pixel_size(Vec3{0, 0, -1}) / kFine;
  EXPECT_NEAR(seen * pixel * pixel / (std::numbers::pi * kRadius * kRadius), 1, 0.01);
  EXPECT_EQ(image.pixel(0, 0)[0], 255);
  EXPECT_EQ(image.pixel(159, 119)[2], 255);
}

TEST(Picture, ThreadsDoNotChangeIt) {
  const ScalarGrid grid = generate_field("shells", 20);
  const IsosurfaceShape shape(grid, 100.5);
  const Camera camera(View(), shape.outermost_points(), 50, 40);
  PictureOptions options;
  Image one(50, 40);
  draw(shape, grid.box(), camera, options, 0, one);
  options.threads = 3;
  Image three(50, 40);
  draw(shape, grid.box(), camera, options, 0, three);
  EXPECT_EQ(one.rgb, three.rgb);
  EXPECT_GT(std::count_if(one.rgb.begin(), one.rgb.end(), [](std::uint8_t byte) { return byte < 250; }), 1000);
}

TEST(Picture, ACutShowsTheInsideInItsOwnColour) {
  const ScalarGrid grid = sphere_grid();
  const IsosurfaceShape shape(grid, 0);
  View view;
  view.azimuth = 0;
  view.elevation = 0;
  const Camera camera(view, shape.outermost_points(), 60, 60);
  Image whole(60, 60);
  Image cut(60, 60);
  draw(shape, grid.box(), camera, PictureOptions(), 0, whole);
  const Box3 kept = kept_box(grid.box(), {parse_clip_plane("x=12", "--clip")}, camera.toward_eye(), "--clip");
  draw(shape, kept, camera, PictureOptions(), 0, cut);
  EXPECT_GT(whole.pixel(30, 30)[0], whole.pixel(30, 30)[2] + 30);  // the outside is warm
  EXPECT_LT(cut.pixel(30, 30)[0] + 30, cut.pixel(30, 30)[2]);      // the inside is cold
  // Cut before its beginning there is nothing left of it.
  Image nothing(60, 60);
  draw(shape, kept_box(grid.box(), {{0, 2.0}}, camera.toward_eye(), "--clip"), camera, PictureOptions(), 0, nothing);
  EXPECT_EQ(nothing.rgb, Image(60, 60).rgb);
}

TEST(Picture, LinesAreAsWideAsAskedForAtEveryZoom) {
  // Two triangles in the plane x = 0 with an upright edge between them.
  const MeshShape shape({{{0, -1, 0}, {0, 0, -1.5}, {0, 0, 1.5}, {0, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}});
  for (const double zoom : {1.0, 2.0, 5.0}) {
    for (const double width : {1.0, 2.5}) {
      View view;
      view.azimuth = 0;
      view.elevation = 0;
      view.zoom = zoom;
      const Camera camera(view, shape.mesh().points, 200, 200);
      PictureOptions options;
      options.line_width = width;
      Image image(200, 200);
      draw(shape, {{-1, -2, -2}, {1, 2, 2}}, camera, options, 0, image);
      const double surface = linear(image.pixel(115, 100)[0]);
      double dark = 0;
      for (int x = 90; x < 110; ++x) dark += 1 - linear(image.pixel(x, 100)[0]) / surface;
      EXPECT_NEAR(dark, width, 0.1 * width) << zoom;
    }
  }
}

TEST(Lighting, FallsAsASurfaceTurnsAwayAndWhereItIsHidden) {
  const auto brightness = [](const LitPoint& point) {
    const Colour colour = lit(point);
    return colour.x + colour.y + colour.z;
  };
  // From the light over the left shoulder away from the eye.
  const Vec3 light{-2.0 / 7, 3.0 / 7, 6.0 / 7};
  const Vec3 away = Vec3{light.x, light.y, 0} / norm({light.x, light.y, 0});
  const double start = std::acos(light.z);
  double last = kInfinity;
  for (double angle = start; angle < std::numbers::pi / 2; angle += 0.02) {
    const double now = brightness({std::cos(angle) * Vec3{0, 0, 1} + std::sin(angle) * away, true, 1, 0});
    EXPECT_LT(now, last) << angle;
    last = now;
  }
  for (const bool outside : {false, true}) {
    double lighter = kInfinity;
    for (const double openness : {1.0, 0.7, 0.4, 0.1}) {
      const double now = brightness({light, outside, openness, 0});
      EXPECT_LT(now, lighter);
      EXPECT_LT(brightness({light, outside, openness, 0.5}), now);
      lighter = now;
    }
  }
  EXPECT_EQ(srgb({0, 0, 0})[0], 0);
  EXPECT_EQ(srgb({1, 2, -1}), (std::array<std::uint8_t, 3>{255, 255, 0}));
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(srgb({linear(static_cast<std::uint8_t>(byte)), 0, 0})[0], byte);
  }
}

}  // namespace
}  // namespace deliso::testing
