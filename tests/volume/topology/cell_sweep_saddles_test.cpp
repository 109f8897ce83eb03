// Saddles of the field in one cell: on which side of the isovalue they are, and where those of the surface lie.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "volume/topology/cell_sweep.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

__extension__ using Wide = __int128;

// A cell alone: its faces lie on the box.
bool is_singular(const CellSweep& sweep) { return sweep.singular_inside() || sweep.saddle_faces() != 0; }

TEST(AboveJoinedOnFace, AgreesWithExactIntegers) {
  Rng rng(17);
  int close = 0;
  for (int i = 0; i < 20000; ++i) {
    // Products that agree in all but their last bits: ad - bc = -x z delta.
    const auto x = static_cast<std::int64_t>(rng.next() >> 38) + 1;
    const auto y = static_cast<std::int64_t>(rng.next() >> 38) + 2;
    const auto z = static_cast<std::int64_t>(rng.next() >> 38) + 1;
    const auto w = static_cast<std::int64_t>(rng.next() >> 38) + 1;
    const std::int64_t delta = static_cast<std::int64_t>(rng.below(3)) - 1;
    const std::int64_t a = x * y;
    const std::int64_t b = x * z;
    const std::int64_t c = y * w + delta;
    const std::int64_t d = z * w;
    CellCorners corners{};
    corners[0] = static_cast<double>(a);
    corners[1] = static_cast<double>(-b);
    corners[2] = static_cast<double>(-c);
    corners[3] = static_cast<double>(d);
    for (std::size_t k = 4; k < 8; ++k) corners[k] = 1;
    const Wide determinant = Wide(a) * d - Wide(b) * c;
    if (std::abs(static_cast<double>(determinant)) < 0x1p-49 * static_cast<double>(a) * static_cast<double>(d)) ++close;
    ASSERT_EQ(above_joined_on_face(corners, 0, 4), determinant >= 0) << "case " << i << " after seed 17";
  }
  EXPECT_GT(close, 100);
}

TEST(CellSweep, ReportsASaddleAtTheIsovalueOnAFace) {
  // On the face w = 0: 2 * 6 - 3 * 4 = 0.
  const CellCorners corners{2, -3, -4, 6, 1, 1, 1, 1};
  for (const test::CubeSymmetry& symmetry : test::cube_symmetries()) {
    CellCorners moved;
    for (int c = 0; c < 8; ++c)
      moved[static_cast<std::size_t>(c)] = corners[static_cast<std::size_t>(test::source_corner(symmetry, c))];
    EXPECT_EQ(std::popcount(CellSweep(moved, 0).saddle_faces()), 1);
  }
  EXPECT_FALSE(is_singular(CellSweep({2, -3, -4, std::nextafter(6, 7), 1, 1, 1, 1}, 0)));
  EXPECT_FALSE(is_singular(CellSweep({2, -3, -4, std::nextafter(6, 5), 1, 1, 1, 1}, 0)));
}

// xy + yz + zx has its saddle, with value 0, at the origin: inside the cell [low, high]^3.
CellCorners saddle_cell(double low, double high) {
  CellCorners corners;
  for (unsigned c = 0; c < 8; ++c) {
    const double x = (c & 1u) != 0 ? high : low;
    const double y = (c & 2u) != 0 ? high : low;
    const double z = (c & 4u) != 0 ? high : low;
    corners[c] = x * y + y * z + z * x;
  }
  return corners;
}

TEST(CellSweep, ReportsASaddleAtTheIsovalueInside) {
  for (const auto& [low, high] : {std::pair{-1.0, 1.0}, {-2.0, 3.0}, {-7.0, 5.0}, {-100.0, 101.0}}) {
    const CellCorners corners = saddle_cell(low, high);
    EXPECT_TRUE(CellSweep(corners, 0).singular_inside()) << low;
    // Slightly above the saddle value the two sheets are separate, slightly below they are joined by a tunnel.
    const double step = std::ldexp(1.0, -60);
    EXPECT_FALSE(is_singular(CellSweep(corners, step)));
    EXPECT_FALSE(is_singular(CellSweep(corners, -step)));
    EXPECT_EQ(CellSweep(corners, step).pieces(), 2);
    EXPECT_EQ(CellSweep(corners, -step).pieces(), 1);
    EXPECT_EQ(CellSweep(corners, -step).euler_characteristic(0), 0);
  }
}

TEST(CellSweep, SaddlesOfTheSweepLieOnTheSurface) {
  Rng rng(18);
  int found = 0;
  for (int i = 0; i < 30000; ++i) {
    CellCorners corners;
    for (double& f : corners) f = rng.uniform(-1, 1);
    const CellSweep sweep(corners, 0);
    for (int s = 0; s < sweep.saddle_count(); ++s) {
      const CellSweep::Saddle& saddle = sweep.saddle(s);
      ASSERT_NEAR(trilinear_value(corners, saddle.uvw), 0, 1e-6) << "case " << i << " after seed 18";
      const Vec3 gradient = trilinear_gradient(corners, saddle.uvw);
      ASSERT_NEAR(gradient.x, 0, 1e-6) << "case " << i;
      ASSERT_NEAR(gradient.y, 0, 1e-6) << "case " << i;
      ++found;
    }
  }
  EXPECT_GT(found, 500);
}

// Small integers: the quadratic whose roots place the saddles is often linear, exactly.
TEST(CellSweep, SaddlesOfIntegerCellsLieOnTheSurfaceToo) {
  Rng rng(20);
  int found = 0;
  for (int i = 0; i < 30000; ++i) {
    CellCorners corners;
    for (double& f : corners) f = static_cast<double>(rng.below(8));
    const CellSweep sweep(corners, 3.5);
    if (sweep.singular_inside() || sweep.saddle_faces() != 0) continue;
    for (int s = 0; s < sweep.saddle_count(); ++s) {
      ASSERT_NEAR(trilinear_value(corners, sweep.saddle(s).uvw), 3.5, 1e-6) << "case " << i << " after seed 20";
      ++found;
    }
  }
  EXPECT_GT(found, 500);
}

// The upper samples are the lower ones minus 39.
TEST(CellSweep, TheSaddleOfAPrismLiesOnTheSurface) {
  const CellCorners corners{187, 142, 142, 192, 148, 103, 103, 153};
  const CellSweep sweep(corners, 127.5);
  ASSERT_EQ(sweep.saddle_count(), 1);
  EXPECT_NEAR(trilinear_value(corners, sweep.saddle(0).uvw), 127.5, 1e-9);
}

}  // namespace
}  // namespace deliso
