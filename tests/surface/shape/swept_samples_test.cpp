#include "surface/shape/swept_samples.h"

#include <gtest/gtest.h>

#include <vector>

namespace deliso {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

Triangles octahedron(const Vec3& middle, double radius) {
  Triangles faces;
  for (const double x : {-radius, radius}) {
    for (const double y : {-radius, radius}) {
      for (const double z : {-radius, radius}) {
        const Vec3 a = middle + Vec3{x, 0, 0}, b = middle + Vec3{0, y, 0}, c = middle + Vec3{0, 0, z};
        if (x * y * z > 0) {
          faces.push_back({a, b, c});
        } else {
          faces.push_back({a, c, b});
        }
      }
    }
  }
  return faces;
}

// A grid with samples above at those places, below everywhere else.
ScalarGrid grid_with(const std::vector<std::size_t>& above) {
  std::vector<double> samples(125, 0.0);
  for (const std::size_t i : above) samples[i] = 1;
  return ScalarGrid({5, 5, 5}, std::move(samples));
}

constexpr std::size_t kMiddle = 2 + 5 * (2 + 5 * 2);

TEST(SweptSamples, ABubbleMustKeepItsSample) {
  const ScalarGrid grid = grid_with({kMiddle});
  const Isosurface isosurface(grid, 0.9, {});
  const Vec3 middle{2, 2, 2};
  const Triangles around = octahedron(middle, 0.1);
  EXPECT_FALSE(sweeps_lone_sample(around, octahedron(middle, 0.05), isosurface));
  EXPECT_TRUE(sweeps_lone_sample(around, octahedron(middle + Vec3{0.2, 0, 0}, 0.1), isosurface));
  EXPECT_TRUE(sweeps_lone_sample(around, {}, isosurface));
  // One corner drawn across the sample: the sample lies beyond the faces at it.
  Triangles cut = around;
  for (auto& face : cut) {
    for (Vec3& p : face) {
      if (p == middle + Vec3{0.1, 0, 0}) p = middle + Vec3{-0.02, 0, 0};
    }
  }
  EXPECT_TRUE(sweeps_lone_sample(around, cut, isosurface));
}

// As the bubbles of four crossings have it, of which two lie on one line of the grid.
TEST(SweptSamples, ABubbleWithItsSampleOnAnEdgeMayGoAroundItAndMustNotLeaveIt) {
  const ScalarGrid grid = grid_with({kMiddle});
  const Isosurface isosurface(grid, 0.9, {});
  const Vec3 low{2, 2, 1.9}, high{2, 2, 2.1}, x{2.1, 2, 2}, y{2, 2.1, 2};
  const auto tetrahedron = [&](const Vec3& bottom, const Vec3& top) {
    return Triangles{{bottom, y, x}, {top, x, y}, {bottom, x, top}, {top, y, bottom}};
  };
  const Triangles bubble = tetrahedron(low, high);
  EXPECT_TRUE(sweeps_lone_sample(bubble, tetrahedron({2.01, 2.01, 1.9}, {2.01, 2.01, 2.1}), isosurface));
  EXPECT_FALSE(sweeps_lone_sample(bubble, tetrahedron({1.99, 1.99, 1.9}, {1.99, 1.99, 2.1}), isosurface));
  EXPECT_FALSE(sweeps_lone_sample(bubble, tetrahedron(low, {2, 2, 2.05}), isosurface));
}

TEST(SweptSamples, ASampleWithANeighbourOnItsSideDoesNotCount) {
  const ScalarGrid grid = grid_with({kMiddle, kMiddle + 1});
  const Isosurface isosurface(grid, 0.9, {});
  EXPECT_FALSE(sweeps_lone_sample(octahedron({2, 2, 2}, 0.1), {}, isosurface));
}

// At a face of the box the bubble is open, and the sample sees half of it.
TEST(SweptSamples, CountsSamplesInAFaceOfTheBox) {
  const ScalarGrid grid = grid_with({2 + 5 * (2 + 5 * 0)});
  const Isosurface isosurface(grid, 0.9, {});
  Triangles half;
  for (const auto& face : octahedron({2, 2, 0}, 0.1)) {
    if (face[0].z >= 0 && face[1].z >= 0 && face[2].z >= 0) half.push_back(face);
  }
  EXPECT_EQ(half.size(), 4U);
  EXPECT_TRUE(sweeps_lone_sample(half, {}, isosurface));
}

}  // namespace
}  // namespace deliso
