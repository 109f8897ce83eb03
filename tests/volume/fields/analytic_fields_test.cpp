// The built-in fields: their topology by a second method, their values at known points, their sizes and seeds.
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/volume_files.h"
#include "tests/support/volume_tetrahedra_topology.h"
#include "volume/regular_isovalue.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

using Components = std::vector<std::pair<std::int64_t, std::int64_t>>;

Components expanded(const std::vector<KnownComponents>& known) {
  Components out;
  for (const KnownComponents& k : known)
    out.insert(out.end(), static_cast<std::size_t>(k.count), {k.euler_characteristic, k.boundary_loops});
  std::sort(out.begin(), out.end());
  return out;
}

bool touches_a_face(const ScalarGrid& grid, double isovalue) {
  const Dims& n = grid.dims();
  for (std::int32_t k = 0; k < n[2]; ++k)
    for (std::int32_t j = 0; j < n[1]; ++j)
      for (std::int32_t i = 0; i < n[0]; ++i) {
        const bool outer = i == 0 || j == 0 || k == 0 || i == n[0] - 1 || j == n[1] - 1 || k == n[2] - 1;
        if (outer && grid.at(i, j, k) >= isovalue) return true;
      }
  return false;
}

// The volume above the isovalue in units of the cube [-1, 1]^3, by midpoint sampling of the interpolant.
double volume_above(const ScalarGrid& grid, double isovalue) {
  constexpr int kParts = 3;
  std::int64_t count = 0;
  for (std::int32_t k = 0; k < grid.dims()[2] - 1; ++k)
    for (std::int32_t j = 0; j < grid.dims()[1] - 1; ++j)
      for (std::int32_t i = 0; i < grid.dims()[0] - 1; ++i) {
        const CellCorners corners = grid.cell(i, j, k);
        for (int n = 0; n < kParts * kParts * kParts; ++n) {
          const int row = n / kParts;
          const int slice = row / kParts;
          const Vec3 uvw{(n % kParts + 0.5) / kParts, (row % kParts + 0.5) / kParts, (slice + 0.5) / kParts};
          count += trilinear_value(corners, uvw) > isovalue ? 1 : 0;
        }
      }
  const double part = 2.0 / (grid.dims()[0] - 1) / kParts;
  return static_cast<double>(count) * part * part * part;
}

TEST(AnalyticFields, NamesAreUniqueAndEveryFieldIsAsItsEntrySays) {
  std::set<std::string> names;
  for (const AnalyticField& field : analytic_fields()) {
    SCOPED_TRACE(field.name);
    EXPECT_TRUE(names.insert(field.name).second);
    EXPECT_FALSE(field.description.empty());
    const ScalarGrid grid = generate_field(field.name, field.default_size);
    EXPECT_EQ(grid.type_name(), field.type_name);
    EXPECT_EQ(grid.dims(), (Dims{field.default_size, field.default_size, field.default_size}));
    EXPECT_LT(grid.range().first, field.isovalue);
    EXPECT_GT(grid.range().second, field.isovalue);
    EXPECT_EQ(touches_a_face(grid, field.isovalue), !field.closed);
  }
}

TEST(AnalyticFields, TopologyIsTheKnownOneAtSeveralSizes) {
  for (const AnalyticField& field : analytic_fields()) {
    const std::int32_t low = field.smallest_known_size;
    for (const std::int32_t size : {low, low + 1, low + low / 3, field.default_size}) {
      const auto known = field.known_topology(size);
      if (!known) continue;
      for (const std::uint64_t seed : {1u, 2u}) {
        if (seed == 2 && !field.seeded) continue;
        SCOPED_TRACE(field.name + " size " + std::to_string(size) + " seed " + std::to_string(seed));
        const ScalarGrid grid = generate_field(field.name, size, seed);
        EXPECT_EQ(TetrahedraTopology(grid, field.isovalue).components(), expanded(*known));
      }
    }
    EXPECT_FALSE(field.known_topology(low - 1).has_value()) << field.name;
  }
}

TEST(AnalyticFields, TheSecondOpinionKnowsAnOpenCylinderAndATorusCutInHalf) {
  // A cylinder from face to face: an annulus, chi 0 and two loops. Half a torus: an annulus too, both loops on one
  // face.
  const Dims dims{16, 16, 16};
  std::vector<float> cylinder;
  std::vector<float> half_torus;
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i) {
        cylinder.push_back(static_cast<float>(-std::hypot(i - 7.5, j - 7.5)));
        half_torus.push_back(static_cast<float>(-std::hypot(std::hypot(i - 7.5, k - 0.2) - 4.6, j - 7.5)));
      }
  EXPECT_EQ(TetrahedraTopology(ScalarGrid(dims, cylinder), -4.03).components(), (Components{{0, 2}}));
  EXPECT_EQ(TetrahedraTopology(ScalarGrid(dims, half_torus), -2.03).components(), (Components{{0, 2}}));
}

TEST(AnalyticFields, SuggestedIsovaluesAreRegularForEverySizeAndSeed) {
  for (const AnalyticField& field : analytic_fields())
    for (const std::int32_t size : {8, 17, 24, 33})
      for (const std::uint64_t seed : {1u, 2u, 3u})
        EXPECT_EQ(regular_isovalue(generate_field(field.name, size, seed), field.isovalue), field.isovalue)
            << field.name << " size " << size << " seed " << seed;
}

TEST(AnalyticFields, EqualSeedsGiveEqualSamplesAndOtherSeedsMatterWhereDeclared) {
  for (const AnalyticField& field : analytic_fields()) {
    const ScalarGrid once = generate_field(field.name, 12, 7);
    EXPECT_EQ(once.samples(), generate_field(field.name, 12, 7).samples()) << field.name;
    EXPECT_EQ(once.samples() != generate_field(field.name, 12, 8).samples(), field.seeded) << field.name;
  }
}

TEST(AnalyticFields, BlobsStayClosedForManySeeds) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_FALSE(touches_a_face(generate_field("blobs", 20, seed), find_analytic_field("blobs").isovalue)) << seed;
}

TEST(AnalyticFields, VolumesOfSphereAndTorusAreTheTextbookOnes) {
  constexpr double kPi = std::numbers::pi;
  const double ball = 4.0 / 3.0 * kPi * 0.7 * 0.7 * 0.7;
  EXPECT_NEAR(volume_above(generate_field("sphere", 48), 0.3), ball, 0.005 * ball);
  const double ring = 2 * kPi * kPi * 0.6 * 0.3 * 0.3;
  EXPECT_NEAR(volume_above(generate_field("torus", 48), 0.7), ring, 0.01 * ring);
  // The plane cuts the cube at dot(p, n) = 0.1: above it lies 4 - 4 * 0.1 / 0.9 (its mean height over the x-y square).
  EXPECT_NEAR(volume_above(generate_field("plane", 32), 0.1), 4 - 4 * 0.1 / 0.9, 0.002);
}

TEST(AnalyticFields, SignsAtKnownPointsOfTheShells) {
  const ScalarGrid grid = generate_field("shells", 65);
  const double isovalue = find_analytic_field("shells").isovalue;
  const auto inside = [&](std::int32_t i, std::int32_t j, std::int32_t k) { return grid.at(i, j, k) > isovalue; };
  EXPECT_TRUE(inside(32, 32, 32));        // the ball
  EXPECT_FALSE(inside(32 + 9, 32, 32));   // between ball and ring
  EXPECT_TRUE(inside(32 + 14, 32, 32));   // the ring
  EXPECT_FALSE(inside(32, 32, 32 + 14));  // above its hole
  EXPECT_FALSE(inside(32 + 20, 32, 32));  // between ring and shell
  EXPECT_TRUE(inside(32 + 26, 32, 32));   // the shell
  EXPECT_TRUE(inside(32, 32, 32 - 23));   // its flatter side
  EXPECT_FALSE(inside(0, 32, 32));        // outside
}

TEST(AnalyticFields, PlaneIsReproducedByTheInterpolant) {
  const ScalarGrid grid = generate_field("plane", 9);
  for (int n = 0; n < 100; ++n) {
    Rng rng(static_cast<std::uint64_t>(n));
    const Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
    const CellCorners corners = grid.cell(3, 5, 2);
    const Vec3 world = Vec3{3 + p.x, 5 + p.y, 2 + p.z} / 4.0 - Vec3{1, 1, 1};
    EXPECT_NEAR(trilinear_value(corners, p), 0.2 * world.x + 0.3 * world.y + 0.9 * world.z, 1e-15) << "seed " << n;
  }
}

TEST(AnalyticFields, SheetsAreAsFarApartAsTheIsovalueSays) {
  // Along a column the two crossings are distance / cos(tilt) apart.
  const ScalarGrid grid = generate_field("sheets", 40);
  const double cosine = 1 / std::sqrt(1 + 0.15 * 0.15 + 0.23 * 0.23);
  const double isovalue = 3.1;
  std::vector<double> crossings;
  for (std::int32_t k = 0; k + 1 < 40; ++k) {
    const double a = grid.at(11, 30, k) - isovalue;
    const double b = grid.at(11, 30, k + 1) - isovalue;
    if ((a > 0) != (b > 0)) crossings.push_back(k + a / (a - b));
  }
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_NEAR(crossings[1] - crossings[0], 2 * isovalue / cosine, 1e-4);
}

TEST(AnalyticFields, BadNamesAndSizesAreNamed) {
  expect_input_error([] { generate_field("spehre", 16); }, {"\"spehre\"", "\"sphere\""});
  expect_input_error([] { generate_field("linked_torus", 16); }, {"\"linked_torus\"", "\"linked_tori\""});
  expect_input_error([] { generate_field("", 16); }, {"\"\""});
  expect_input_error([] { generate_field("sphere", 1); }, {"size", "1", "2 to 2048"});
  expect_input_error([] { generate_field("sphere", 2049); }, {"2049"});
  expect_input_error([] { generate_field("sphere", -5); }, {"-5"});
}

}  // namespace
}  // namespace deliso
