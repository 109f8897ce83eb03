#include "volume/topology/critical_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "delaunay/base/rng.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

CellCorners random_corners(Rng& rng, std::uint64_t range) {
  CellCorners corners{};
  for (double& c : corners) c = static_cast<double>(rng.below(range));
  return corners;
}

// The second derivatives d2g/dxdy and so on at a point (the pure ones vanish), from differences of the gradient.
std::array<double, 3> mixed_derivatives(const CellCorners& corners, const Vec3& p) {
  const auto gradient = [&](double x, double y, double z) { return trilinear_gradient(corners, {x, y, z}); };
  return {gradient(1, p.y, p.z).y - gradient(0, p.y, p.z).y, gradient(p.x, 1, p.z).z - gradient(p.x, 0, p.z).z,
          gradient(1, p.y, p.z).z - gradient(0, p.y, p.z).z};
}

// Newton's method on the gradient; where it ends, if it does and the point is isolated.
std::optional<Vec3> newton(const CellCorners& corners, Vec3 p) {
  for (int i = 0; i < 60; ++i) {
    const Vec3 g = trilinear_gradient(corners, p);
    const auto [xy, yz, xz] = mixed_derivatives(corners, p);
    // Inverse of the symmetric matrix with zero diagonal.
    const double det = 2 * xy * yz * xz;
    if (std::abs(det) < 1e-3) return std::nullopt;
    const Vec3 step = {(-yz * yz * g.x + xz * yz * g.y + xy * yz * g.z) / det,
                       (xz * yz * g.x - xz * xz * g.y + xy * xz * g.z) / det,
                       (xy * yz * g.x + xy * xz * g.y - xy * xy * g.z) / det};
    p = p - step;
    if (!is_finite(p) || norm(p) > 100) return std::nullopt;
    if (norm(step) < 1e-13) return p;
  }
  return std::nullopt;
}

bool on_face(const Vec3& p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] == 0 || p[axis] == 1) return true;
  }
  return false;
}

TEST(CriticalPoints, GradientsVanishAtThemAndValuesAreTheInterpolants) {
  int faces = 0;
  int bodies = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng rng(seed);
    const CellCorners corners = random_corners(rng, 256);
    std::vector<CriticalPoint> points;
    append_critical_points(corners, points);
    for (const CriticalPoint& point : points) {
      EXPECT_EQ(point.value, trilinear_value(corners, point.uvw));
      Vec3 gradient = trilinear_gradient(corners, point.uvw);
      const bool is_face = on_face(point.uvw);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = point.uvw[axis];
        EXPECT_TRUE(x >= 0 && x <= 1);
        if (x == 0 || x == 1) gradient[axis] = 0;  // on a face only the derivatives along it vanish
      }
      EXPECT_LT(norm(gradient), 1e-7) << "seed " << seed;
      (is_face ? faces : bodies) += 1;
    }
  }
  EXPECT_GT(faces, 500);
  EXPECT_GT(bodies, 200);
}

TEST(CriticalPoints, NewtonFromManyStartsFindsNoOtherBodySaddle) {
  int found = 0;
  // Few values: then terms of the polynomial vanish often.
  for (const std::uint64_t range : {3u, 5u, 256u}) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      Rng rng(seed);
      const CellCorners corners = random_corners(rng, range);
      std::vector<CriticalPoint> points;
      append_critical_points(corners, points);
      for (int start = 0; start < 64; ++start) {
        const auto end = newton(corners, Vec3{start % 4 + 0.4, start / 4 % 4 + 0.45, start / 16 + 0.55} / 4);
        if (!end || std::min({end->x, end->y, end->z}) < 1e-6 || std::max({end->x, end->y, end->z}) > 1 - 1e-6)
          continue;
        EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                                [&](const CriticalPoint& p) { return distance(p.uvw, *end) < 1e-5; }))
            << "range " << range << " seed " << seed << " at " << end->x << " " << end->y << " " << end->z;
        ++found;
      }
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(CriticalPoints, AFaceHasASaddleExactlyWhenItsDiagonalsOutweighEachOther) {
  // A bilinear face has a saddle inside exactly when both samples of one diagonal exceed both of the other.
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Rng rng(seed);
    const CellCorners corners = random_corners(rng, 10);
    std::vector<CriticalPoint> points;
    append_critical_points(corners, points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t u = std::size_t{1} << ((axis + 1) % 3);
        const std::size_t v = std::size_t{1} << ((axis + 2) % 3);
        const std::size_t base = side << axis;
        const auto [low1, high1] = std::minmax(corners[base], corners[base | u | v]);
        const auto [low2, high2] = std::minmax(corners[base | u], corners[base | v]);
        const auto count = std::count_if(points.begin(), points.end(), [&](const CriticalPoint& p) {
          return p.uvw[axis] == static_cast<double>(side);
        });
        EXPECT_EQ(count, high1 < low2 || high2 < low1 ? 1 : 0) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace deliso
