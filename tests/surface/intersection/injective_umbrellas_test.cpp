#include "surface/intersection/injective_umbrellas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/triangle_contact.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

constexpr double kTurn = 6.283185307179586;

std::vector<std::uint8_t> laid_out(const TriangleMesh& mesh, int threads = 1) {
  std::vector<ProjectedTriangle> projected;
  for (const auto& [a, b, c] : mesh.triangles) projected.emplace_back(mesh.points[a], mesh.points[b], mesh.points[c]);
  const VertexCorners corners(mesh.points.size(), mesh.triangles, [](std::size_t) { return true; });
  return injective_umbrellas(mesh.triangles, projected, corners, mesh.points.size(), threads);
}

// Vertex 0 with its spokes in a row, closed up.
TriangleMesh fan(const std::vector<Vec3>& spokes) {
  TriangleMesh mesh;
  mesh.points.push_back({0, 0, 0});
  const auto count = static_cast<std::uint32_t>(spokes.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.points.push_back(spokes[i]);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return mesh;
}

std::vector<Vec3> spokes_around(std::size_t count, double turns) {
  std::vector<Vec3> spokes;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = turns * kTurn * static_cast<double>(i) / static_cast<double>(count);
    spokes.push_back({std::cos(angle), std::sin(angle), 0.1 * static_cast<double>(i)});
  }
  return spokes;
}

// Fans with corners on a small grid, in random directions, more or less in order around the vertex.
TEST(InjectiveUmbrellas, HaveNoTrianglesThatMeet) {
  std::array<int, 2> with_contact{}, without{};
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Rng rng(seed);
    std::vector<Vec3> spokes = spokes_around(3 + rng.below(6), 1);
    const double size = 1 + 3 * rng.uniform(), height = rng.uniform(0, 4);
    const std::size_t up = rng.below(3);
    for (Vec3& spoke : spokes) {
      const std::array<double, 3> at = {size * spoke.x + rng.uniform(-1, 1), size * spoke.y + rng.uniform(-1, 1),
                                        rng.uniform(-height, height)};
      for (std::size_t k = 0; k < 3; ++k) spoke[(k + 1 + up) % 3] = std::round(at[k]);
    }
    TriangleMesh mesh = fan(spokes);
    for (auto& corners : mesh.triangles) {
      std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(rng.below(3)), corners.end());
    }
    for (std::size_t i = mesh.triangles.size(); i > 1; --i)
      std::swap(mesh.triangles[i - 1], mesh.triangles[rng.below(i)]);
    const bool is_flat = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
      return !has_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    });
    if (is_flat) continue;
    bool any_contact = false;
    for (std::size_t s = 0; s < mesh.triangles.size(); ++s) {
      for (std::size_t t = s + 1; t < mesh.triangles.size(); ++t) {
        any_contact = any_contact ||
                      triangle_contact(mesh.points, mesh.triangles[s], mesh.triangles[t]) != TriangleContact::kNone;
      }
    }
    const std::uint8_t found = laid_out(mesh)[0];
    EXPECT_FALSE(found != 0 && any_contact) << "seed " << seed;
    ++(any_contact ? with_contact : without)[found];
  }
  EXPECT_GT(with_contact[0], 300);
  EXPECT_GT(without[1], 1000);
}

TEST(ProjectedTriangle, TellsSensesAndStraddledCorners) {
  std::size_t certain = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    std::array<Vec3, 3> p;
    for (Vec3& q : p) {
      // On a small grid, for ties.
      for (std::size_t k = 0; k < 3; ++k) q[k] = std::floor(rng.uniform(0, 4));
    }
    const ProjectedTriangle triangle(p[0], p[1], p[2]);
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);  // exact
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(triangle.senses() >> k & 1U, normal[k] > 0 ? 1U : 0U) << "seed " << seed;
      EXPECT_EQ(triangle.senses() >> (3 + k) & 1U, normal[k] < 0 ? 1U : 0U) << "seed " << seed;
      certain += normal[k] != 0 ? 1U : 0U;
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Vec3 &own = p[i], &next = p[(i + 1) % 3], &previous = p[(i + 2) % 3];
      const unsigned x = (next.x < own.x) != (previous.x < own.x) ? 1U : 0U;
      const unsigned y = (next.y < own.y) != (previous.y < own.y) ? 2U : 0U;
      EXPECT_EQ(triangle.straddles(i), x | y) << "seed " << seed;
    }
  }
  EXPECT_GT(certain, 3000U);
}

// Next to the line y = 3 x, closer than the rounding of a determinant: what is said is right.
TEST(ProjectedTriangle, SaysNothingWrongNextToALine) {
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const double x = 0.5 + i * 0x1p-53, y = 1.5 + j * 0x1p-52;
      const ProjectedTriangle triangle({-12, -36, 0}, {24, 72, 0}, {x, y, 0});
      const std::uint32_t along_z = triangle.senses() >> 2 & 9U;
      EXPECT_TRUE(along_z == 0 || along_z == (2 * j > 3 * i ? 1U : 2 * j < 3 * i ? 8U : 64U)) << i << " " << j;
    }
  }
}

// Steps along the axes, and corners in line with the vertex.
TEST(InjectiveUmbrellas, AreThoseOfARegularGrid) {
  for (std::size_t up = 0; up < 3; ++up) {
    for (const bool is_diagonal : {false, true}) {
      std::vector<Vec3> spokes;
      for (const auto& [x, y] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}) {
        Vec3 spoke;
        spoke[(up + 1) % 3] = is_diagonal ? x + y : x;
        spoke[(up + 2) % 3] = is_diagonal ? x - y : y;
        spokes.push_back(spoke);
      }
      EXPECT_EQ(laid_out(fan(spokes))[0], 1) << up;
      std::reverse(spokes.begin(), spokes.end());
      EXPECT_EQ(laid_out(fan(spokes))[0], 1) << up;
    }
  }
}

TEST(InjectiveUmbrellas, AreAllOfAFineMesh) {
  for (const TriangleMesh& mesh : {testing::sphere_mesh(4), testing::torus_mesh(40, 30)}) {
    const std::vector<std::uint8_t> found = laid_out(mesh);
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), std::ptrdiff_t(mesh.points.size()));
    EXPECT_EQ(laid_out(mesh, 3), found);
  }
}

TEST(InjectiveUmbrellas, AreNoFansThatAreOpenOrDoubledOrGoAroundTwice) {
  TriangleMesh mesh = fan(spokes_around(7, 1));
  EXPECT_EQ(laid_out(mesh)[0], 1);
  EXPECT_EQ(laid_out(mesh)[1], 0) << "open";
  EXPECT_EQ(laid_out(fan(spokes_around(7, 2)))[0], 0) << "twice around";
  EXPECT_EQ(laid_out(fan(spokes_around(2, 1)))[0], 0);
  EXPECT_EQ(laid_out(fan(spokes_around(100, 1)))[0], 0) << "of more triangles than are looked at";
  EXPECT_EQ(laid_out(fan({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 0.5, 1}}))[0], 0) << "not all the way around";
  EXPECT_EQ(laid_out(fan({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 1, 1}, {-1, -1, 1}}))[0], 0) << "a step back";

  TriangleMesh doubled = mesh;
  doubled.triangles.push_back(mesh.triangles[2]);
  EXPECT_EQ(laid_out(doubled)[0], 0);
  TriangleMesh turned = mesh;
  std::swap(turned.triangles[3][1], turned.triangles[3][2]);
  EXPECT_EQ(laid_out(turned)[0], 0);
  mesh.triangles.pop_back();
  EXPECT_EQ(laid_out(mesh)[0], 0) << "open";
  // Two fans at one vertex, each of which goes around.
  TriangleMesh two = fan(spokes_around(5, 1));
  for (std::uint32_t i = 0; i < 5; ++i) {
    two.points.push_back(two.points[1 + i] + Vec3{0, 0, 2});
    two.triangles.push_back({0, 6 + i, 6 + (i + 1) % 5});
  }
  EXPECT_EQ(laid_out(two)[0], 0);
}

}  // namespace
}  // namespace deliso
