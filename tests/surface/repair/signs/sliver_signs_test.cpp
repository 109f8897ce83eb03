#include "surface/repair/signs/sliver_signs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;

constexpr std::int32_t kSlabSize = 11;
constexpr double kLast = kSlabSize - 1;
constexpr double kHeight = 4.3;

// Points in the plane z = kHeight except for last bits: lattice points on one circle, within which flat tetrahedra lie
// on top of each other, and the points where the sides of the box meet the plane; and the corners of the box, so that
// something lies above and below.
std::vector<Vec3> plane_points(Rng& rng) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < 8; ++i) {
    points.push_back({(i & 1u) != 0 ? kLast : 0, (i & 2u) != 0 ? kLast : 0, (i & 4u) != 0 ? kLast : 0});
  }
  for (std::int32_t y = -5; y <= 5; ++y) {
    for (std::int32_t x = -5; x <= 5; ++x) {
      if (x * x + y * y != 25 && x * x + y * y != 50) continue;
      points.push_back({5.0 + x, 5.0 + y, kHeight + 0x1p-50 * std::floor(4 * rng.uniform())});
    }
  }
  return points;
}

// A volume whose isosurface is that plane.
ScalarGrid plane_grid() {
  std::vector<float> samples;
  for (std::int32_t i = 0; i < kSlabSize * kSlabSize * kSlabSize; ++i)
    samples.push_back(static_cast<float>(i / (kSlabSize * kSlabSize)));
  return {{kSlabSize, kSlabSize, kSlabSize}, std::move(samples)};
}

// Tetrahedra with a corner off the plane get the side on which they lie, flat ones a random side. Returns the number of
// flat ones.
std::size_t give_signs(SignedDelaunay& restricted, Rng& rng) {
  std::size_t flat = 0;
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    if (!delaunay.is_live(TetId(i))) continue;
    double off = 0;
    for (const VertexId v : delaunay.vertices(TetId(i)))
      off += restricted.is_virtual(v) ? 0 : delaunay.point(v).z - kHeight;
    const bool is_flat = std::abs(off) < 1e-9;
    flat += is_flat ? 1 : 0;
    restricted.set_sign(TetId(i), is_flat ? rng.uniform() < 0.5 : off > 0);
  }
  return flat;
}

double restricted_area(const SignedDelaunay& restricted) {
  double area = 0;
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (const testing::FacetName& name : testing::restricted_by_name(restricted)) {
    const VertexId a(name[0]), b(name[1]), c(name[2]);
    if (restricted.is_virtual(a) || restricted.is_virtual(b) || restricted.is_virtual(c)) continue;
    area += 0.5 * norm(cross(delaunay.point(b) - delaunay.point(a), delaunay.point(c) - delaunay.point(a)));
  }
  return area;
}

TEST(SliverSigns, WhateverTheyWereTheSurfacePassesOnce) {
  const ScalarGrid grid = plane_grid();
  const Isosurface isosurface(grid, kHeight, SearchOptions{});
  int folded = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    SignedDelaunay restricted(isosurface, plane_points(rng));
    EXPECT_EQ(slivers(restricted).size(), give_signs(restricted, rng)) << "seed " << seed;
    folded += restricted_area(restricted) > 1.01 * kLast * kLast ? 1 : 0;
    settle_slivers(restricted);
    EXPECT_NEAR(restricted_area(restricted), kLast * kLast, 1e-6) << "seed " << seed;
    const TetSigns settled = restricted.signs();
    settle_slivers(restricted);
    EXPECT_EQ(restricted.signs(), settled) << "seed " << seed;
  }
  EXPECT_GT(folded, 20);
}

TEST(SliverSigns, SignsOfOtherTetrahedraAreLeftAlone) {
  for (const char* name : {"torus", "sheets"}) {
    const auto scene = field_scene(name, 16);
    SignedDelaunay restricted = testing::dense(*scene);
    const TetSigns before = restricted.signs();
    const std::vector<TetId> flat = slivers(restricted);
    settle_slivers(restricted);
    restricted.for_each_difference(
        before, [&](TetId t) { EXPECT_TRUE(std::binary_search(flat.begin(), flat.end(), t)) << name; });
  }
}

}  // namespace
}  // namespace deliso
