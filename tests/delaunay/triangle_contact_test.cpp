#include "delaunay/triangle_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/predicates.h"
#include "tests/support/triangle_oracle.h"

namespace deliso {
namespace {

using testing::IntPoint;

// Two triangles over common points.
struct Pair {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

TriangleContact contact(const Pair& mesh) {
  const TriangleContact there = triangle_contact(mesh.points, mesh.triangles[0], mesh.triangles[1]),
                        back = triangle_contact(mesh.points, mesh.triangles[1], mesh.triangles[0]);
  EXPECT_EQ(there, back) << "not symmetric";
  return there;
}

// In a plane, a corner closer to the other triangle's long edge, on the line y = 3 x, than the rounding of a
// determinant.
TEST(TriangleContact, IsExactNextToAnEdgeInAPlane) {
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const double x = 0.5 + i * 0x1p-53, y = 1.5 + j * 0x1p-52;
      const TriangleContact expected = 2 * j > 3 * i    ? TriangleContact::kNone
                                       : 2 * j == 3 * i ? TriangleContact::kTouching
                                                        : TriangleContact::kCrossing;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Pair mesh{{}, {{0, 1, 2}, {3, 4, 5}}};
        for (const auto& [u, v] : {std::array<double, 2>{-12, -36}, {24, 72}, {24, -36}, {x, y}, {1, 60}, {-5, 60}}) {
          Vec3& p = mesh.points.emplace_back();
          p[(axis + 1) % 3] = u;
          p[(axis + 2) % 3] = v;
        }
        ASSERT_EQ(contact(mesh), expected) << i << " " << j << " " << axis;
      }
    }
  }
}

// Triangles with a corner in common whose edges there run along one ray, on either side of a plane through it: they
// always meet. The second one's middle is that of the first one mirrored in the plane across (1, 2, 3).
TEST(TriangleContact, EdgesAlongACommonRayAlwaysMeet) {
  Rng rng(12);
  const auto integer = [&rng] { return std::floor(rng.uniform(-1000, 1000)); };
  const Vec3 across{1, 2, 3};
  int trials = 0;
  while (trials < 20000) {
    const double q = integer(), r = integer();
    const Vec3 ray{-2 * q - 3 * r, q, r};
    Vec3 middle{0, integer(), integer()};
    middle.x = 7 * integer() - 2 * middle.y - 3 * middle.z;
    const double turn = dot(middle, across) / 7;
    const Vec3 mirrored = middle - turn * across;
    if (ray == Vec3{} || turn <= 0) continue;
    ++trials;
    // All integers: exact.
    const Pair mesh{{{0, 0, 0}, middle - 3 * ray, 3 * ray, 5 * ray, mirrored - 5 * ray}, {{0, 1, 2}, {0, 3, 4}}};
    ASSERT_NE(contact(mesh), TriangleContact::kNone) << trials;
  }
}

// Random triangles on a tiny grid, where every degeneracy is frequent, sharing 0, 1 or 2 vertices.
TEST(TriangleContact, AgreesWithExactSeparatingPlanesOnIntegerGrids) {
  std::array<std::array<std::int64_t, 3>, 3> seen{};  // by shared vertices and answer
  for (std::uint64_t seed = 1; seed <= 60000; ++seed) {
    Rng rng(seed);
    const std::uint32_t shared = static_cast<std::uint32_t>(rng.below(3));
    const std::int64_t size = 2 + static_cast<std::int64_t>(rng.below(4));
    std::vector<IntPoint> points(6 - shared);
    for (IntPoint& p : points) {
      for (std::int64_t& c : p) c = static_cast<std::int64_t>(rng.below(static_cast<std::uint64_t>(size)));
    }
    // The second triangle takes its shared vertices from the first; both are turned at random.
    std::array<std::uint32_t, 3> vs = {0, 1, 2}, vt = {3 - shared, 4 - shared, 5 - shared};
    const auto turn = [&rng](std::array<std::uint32_t, 3>& v) {
      std::rotate(v.begin(), v.begin() + std::ptrdiff_t(rng.below(3)), v.end());
      if (rng.below(2) == 0) std::swap(v[0], v[1]);
    };
    turn(vs);
    turn(vt);
    const auto corners = [&](const std::array<std::uint32_t, 3>& v) {
      return std::array<IntPoint, 3>{points[v[0]], points[v[1]], points[v[2]]};
    };
    const auto flat = [](const std::array<IntPoint, 3>& c) {
      return testing::is_zero(testing::times(testing::minus(c[1], c[0]), testing::minus(c[2], c[0])));
    };
    Pair mesh{{}, {vs, vt}};
    for (const IntPoint& p : points) mesh.points.push_back({double(p[0]), double(p[1]), double(p[2])});
    for (const auto& v : {vs, vt}) {
      ASSERT_EQ(collinear(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]), flat(corners(v)));
    }
    if (flat(corners(vs)) || flat(corners(vt))) continue;
    const TriangleContact expected = testing::expected_contact(corners(vs), corners(vt), vs, vt);
    ASSERT_EQ(contact(mesh), expected) << "seed " << seed;
    ++seen[shared][static_cast<std::size_t>(expected)];
  }
  for (std::size_t shared = 0; shared < 3; ++shared) {
    for (std::size_t answer = 0; answer < 3; ++answer) {
      if (shared == 2 && answer == 1) continue;  // triangles at an edge cannot merely touch
      EXPECT_GT(seen[shared][answer], 100) << shared << " shared, answer " << answer;
    }
  }
}

// The same configurations far from the origin, and coordinates one rounding apart.
TEST(TriangleContact, DecidesOneRoundingApart) {
  const double a = 0.1, above = std::nextafter(a, 1.0), below = std::nextafter(a, 0.0);
  const auto corner_on_face = [](double z_face, double z_corner) {
    return Pair{{{0, 0, z_face}, {3, 0, z_face}, {0, 3, z_face}, {1, 1, z_corner}, {1, 1, 5}, {2, 1, 5}},
                {{0, 1, 2}, {3, 4, 5}}};
  };
  EXPECT_EQ(contact(corner_on_face(a, a)), TriangleContact::kTouching);
  EXPECT_EQ(contact(corner_on_face(a, above)), TriangleContact::kNone);
  EXPECT_EQ(contact(corner_on_face(a, below)), TriangleContact::kCrossing);
  EXPECT_EQ(contact(corner_on_face(1e15, 1e15)), TriangleContact::kTouching) << "from the other side";
  EXPECT_EQ(contact(corner_on_face(-0x1p-160, 0)), TriangleContact::kNone);
}

// A corner as near to a plane of any slope as rounding puts it, the rest of its triangle above.
TEST(TriangleContact, KnowsTheSideOfACornerNearAPlane) {
  std::array<int, 3> seen{};
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Rng rng(seed);
    const double size = std::ldexp(1.0, static_cast<int>(rng.below(60)) - 30);
    const auto random = [&] { return Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; };
    const Vec3 a = size * random(), b = size * random(), c = size * random(), up = cross(b - a, c - a) / size;
    Vec3 p = 0.3 * a + 0.3 * b + 0.4 * c;
    if (rng.below(2) == 0) p += rng.uniform(-1e-13, 1e-13) * up;
    const Vec3 q = p + up + 0.1 * (b - a), r = p + up - 0.1 * (b - a);
    const double side = orient3d(a, b, c, p) * orient3d(a, b, c, q);
    const TriangleContact expected = side > 0   ? TriangleContact::kNone
                                     : side < 0 ? TriangleContact::kCrossing
                                                : TriangleContact::kTouching;
    if (norm(up) < 0.01 * size) continue;  // thin
    EXPECT_EQ(contact({{a, b, c, p, q, r}, {{0, 1, 2}, {3, 4, 5}}}), expected) << "seed " << seed;
    ++seen[static_cast<std::size_t>(expected)];
  }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[2], 1000);
}

TEST(TriangleContact, KnowsHandmadeConfigurations) {
  using C = TriangleContact;
  const std::vector<Vec3> p = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](const Vec3& x, const Vec3& y, const Vec3& z) {
    return Pair{{p[0], p[1], p[2], x, y, z}, {{0, 1, 2}, {3, 4, 5}}};
  };
  EXPECT_EQ(contact(with({1, 1, -1}, {1, 1, 1}, {2, 1, 1})), C::kCrossing);
  EXPECT_EQ(contact(with({1, 1, 0}, {1, 2, 0}, {2, 1, 0})), C::kCrossing) << "contained in one plane";
  EXPECT_EQ(contact(with({0, 0, 0}, {4, 0, 0}, {0, 4, 0})), C::kCrossing) << "equal places, other vertices";
  EXPECT_EQ(contact(with({2, 2, 0}, {4, 4, 0}, {4, 2, 0})), C::kTouching) << "corner on edge in one plane";
  EXPECT_EQ(contact(with({4, 0, 0}, {0, 4, 0}, {4, 4, 0})), C::kTouching) << "same edge, other vertices";
  EXPECT_EQ(contact(with({1, 1, 0}, {2, 1, 0}, {1, 1, 3})), C::kTouching) << "edge lying on the face";
  EXPECT_EQ(contact(with({2, 0, -1}, {2, 0, 1}, {2, -3, 0})), C::kTouching) << "edge across edge";
  EXPECT_EQ(contact(with({9, 9, -1}, {9, 9, 1}, {8, 9, 1})), C::kNone);
  // Sharing a vertex: a fold that pierces, one that lies on the face, one that leaves.
  const auto at_vertex = [&](const Vec3& x, const Vec3& y) {
    return Pair{{p[0], p[1], p[2], x, y}, {{0, 1, 2}, {0, 3, 4}}};
  };
  EXPECT_EQ(contact(at_vertex({1, 1, -1}, {1, 1, 1})), C::kCrossing);
  EXPECT_EQ(contact(at_vertex({1, 1, 0}, {1, 1, 1})), C::kTouching);
  EXPECT_EQ(contact(at_vertex({-1, -1, 0}, {1, 1, 1})), C::kNone);
  EXPECT_EQ(contact(at_vertex({2, 0, 0}, {1, -1, 0})), C::kTouching) << "edges overlap";
  EXPECT_EQ(contact(at_vertex({-2, 0, 0}, {1, -1, 0})), C::kNone);
}

}  // namespace
}  // namespace deliso
