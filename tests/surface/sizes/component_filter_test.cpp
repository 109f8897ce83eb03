// Components left out on purpose: which ones, and that the certificate is of the others.
#include "surface/sizes/component_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

// A solid ball of radius 9 with a cavity of radius 5 in which an island of radius 2 floats, beside a ball of radius 3
// and a speck of radius 1.2: five components.
ScalarGrid solids(double sign = 1) {
  return testing::sampled({40, 25, 25}, [sign](const Vec3& p) {
    const Vec3 middle{11.2, 12.1, 11.9};
    const double r = distance(p, middle);
    const double hollow = std::max(std::min(9 - r, r - 5), 2 - r);
    return sign * std::max({hollow, 3 - distance(p, {30.1, 12.3, 12.2}), 1.2 - distance(p, {36.2, 5.1, 5.2})});
  });
}

template <class Member, class Value>
ComponentParameters with(Member ComponentParameters::*member, Value value) {
  ComponentParameters components;
  components.*member = value;
  return components;
}

MeshingResult kept(const ComponentParameters& components, double max_error = 0.2) {
  MeshingOptions options;
  options.parameters.components = components;
  options.parameters.size.max_error = max_error;
  return mesh_isosurface(solids(), 0, options);
}

std::int64_t components_of(const MeshingResult& result) {
  std::int64_t count = 0;
  for (const TopologyCount& entry : result.certificate.mesh) count += entry.count;
  return count;
}

void expect_kept(const MeshingResult& result, std::int64_t components, const char* what) {
  EXPECT_EQ(components_of(result), components) << what;
  EXPECT_EQ(std::ssize(result.dropped), 5 - components) << what;
  EXPECT_TRUE(is_proven(result.certificate)) << what;
  Promise promise{.max_distance = result.promised_distance, .dropped_components = 5 - components};
  EXPECT_TRUE(verify_mesh(result.mesh, solids(), result.isovalue_used, promise).proven) << what;
  // One more or less than were left out is wrong.
  for (const std::int64_t wrong : {promise.dropped_components - 1, promise.dropped_components + 1}) {
    if (wrong < 0) continue;
    promise.dropped_components = wrong;
    EXPECT_FALSE(verify_mesh(result.mesh, solids(), result.isovalue_used, promise).proven) << what;
  }
}

TEST(ComponentFilter, KeepsTheLargest) {
  expect_kept(kept(with(&ComponentParameters::keep_largest, 1)), 1, "1");
  expect_kept(kept(with(&ComponentParameters::keep_largest, 3)), 3, "3");
  expect_kept(kept(with(&ComponentParameters::keep_largest, 9)), 5, "9");
}

TEST(ComponentFilter, LeavesOutSmallOnes) {
  const double area_of_island = 4 * std::numbers::pi * 4;
  expect_kept(kept(with(&ComponentParameters::min_area, 0.7 * area_of_island)), 4, "speck by area");
  expect_kept(kept(with(&ComponentParameters::min_area, 1.2 * area_of_island)), 3, "speck and island by area");
  expect_kept(kept(with(&ComponentParameters::min_volume, 4.0 / 3 * std::numbers::pi * 12)), 3, "by volume");
  const MeshingResult all = kept(with(&ComponentParameters::min_vertices, 1));
  expect_kept(all, 5, "by one vertex");
  const MeshingResult some = kept(with(&ComponentParameters::min_vertices, 200));
  for (const DroppedPiece& dropped : some.dropped) EXPECT_LT(dropped.piece.vertices, 200);
}

TEST(ComponentFilter, FillsCavitiesWithAllThatIsInThem) {
  const MeshingResult result = kept(with(&ComponentParameters::fill_cavities, true));
  expect_kept(result, 3, "cavities");
  ASSERT_EQ(result.dropped.size(), 2u);
  const double cavity = -4.0 / 3 * std::numbers::pi * 125;
  EXPECT_EQ(result.dropped[0].cause, DropCause::kCavity);
  EXPECT_NEAR(*result.dropped[0].piece.volume, cavity, 0.1 * std::abs(cavity));
  EXPECT_EQ(result.dropped[1].cause, DropCause::kCavity);
  EXPECT_GT(*result.dropped[1].piece.volume, 0);
}

// As signed distances have it: the inside is where the values are low.
TEST(ComponentFilter, FillsCavitiesOfTheSideThatIsInside) {
  MeshingOptions options;
  options.parameters.components.fill_cavities = true;
  options.parameters.field.invert = true;
  const MeshingResult result = mesh_isosurface(solids(-1), 0, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_EQ(components_of(result), 3);
  ASSERT_EQ(result.dropped.size(), 2u);
  EXPECT_EQ(result.dropped[0].cause, DropCause::kCavity);
  EXPECT_LT(*result.dropped[0].piece.volume, 0);
  EXPECT_GT(*result.dropped[1].piece.volume, 0);
  // Where the inside is around these solids, they are its cavities themselves: nothing would be left.
  EXPECT_THROW(mesh_isosurface(solids(), 0, options), InputError);
}

TEST(ComponentFilter, PlainRunsKeepTheirCertificateToo) {
  MeshingOptions options;
  options.parameters.components.keep_largest = 2;
  const MeshingResult result = mesh_isosurface(solids(), 0, options);
  expect_kept(result, 2, "plain");
}

TEST(ComponentFilter, SomethingMustBeLeft) {
  EXPECT_THROW(kept(with(&ComponentParameters::min_area, 1e6)), InputError);
  MeshingOptions options;
  options.parameters.components.keep_largest = 1;
  options.parameters.certify = false;
  options.parameters.repair.max_rounds = 0;
  EXPECT_THROW(mesh_isosurface(solids(), 0, options), InputError);
}

// Another tool's mesh without its second component is no image of the isosurface, unless that was on purpose.
TEST(ComponentFilter, MeshesWithAPieceTooFewAreNotProvenSilently) {
  const MeshingResult result = kept(with(&ComponentParameters::keep_largest, 2));
  EXPECT_FALSE(verify_mesh(result.mesh, solids(), result.isovalue_used).proven);
}

}  // namespace
}  // namespace deliso
