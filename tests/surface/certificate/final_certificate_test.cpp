// The certificate at the end of a run: what takes back counts that are right.
#include "surface/certificate/final_certificate.h"

#include <gtest/gtest.h>

#include <vector>

#include "raycast/isosurface.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

IsosurfaceTopology one_sphere() {
  IsosurfaceTopology topology;
  topology.components = {{2, 0}};
  return topology;
}

TEST(FinalCertificate, HoldsWhereCountsAndPlacesAreRight) {
  const Certificate found = final_certificate(mesh_topology(testing::sphere_mesh(3)), one_sphere(), {}, true);
  EXPECT_EQ(found.verdict, Verdict::kHomeomorphic);
  EXPECT_TRUE(found.differences.empty());
}

TEST(FinalCertificate, FaultsOfPlaceTakeBackRightCounts) {
  for (const auto kind : {&AssignmentFaults::without, &AssignmentFaults::repeated, &AssignmentFaults::unlike,
                          &AssignmentFaults::overrunning}) {
    AssignmentFaults faults;
    (faults.*kind).push_back(0);
    const Certificate found = final_certificate(mesh_topology(testing::sphere_mesh(3)), one_sphere(), faults, true);
    EXPECT_EQ(found.verdict, Verdict::kDifferent);
    EXPECT_EQ(found.differences.size(), 1u);
  }
}

TEST(FinalCertificate, FacetsThatBoundNothingProveNothing) {
  const Certificate right = final_certificate(mesh_topology(testing::sphere_mesh(3)), one_sphere(), {}, false);
  EXPECT_EQ(right.verdict, Verdict::kDifferent);
  EXPECT_EQ(right.differences.size(), 1u);
  // What is wrong besides is said, too.
  const Certificate wrong = final_certificate(mesh_topology(testing::torus_mesh(8, 6)), one_sphere(), {}, false);
  EXPECT_EQ(wrong.verdict, Verdict::kDifferent);
  EXPECT_GT(wrong.differences.size(), 1u);
}

// Mesh space counts in smallest spacings from the first sample.
TEST(FinalCertificate, OnlyPowersOfTwoAreExactInTheWorld) {
  const auto is_exact = [](const Vec3& spacing, const Vec3& origin) {
    const ScalarGrid grid({2, 2, 2}, std::vector<float>{0, 1, 0, 1, 0, 1, 0, 1}, spacing, origin);
    return is_exact_in_world(Isosurface(grid, 0.5, SearchOptions()));
  };
  EXPECT_TRUE(is_exact({1, 1, 1}, {}));
  EXPECT_TRUE(is_exact({0.25, 0.5, 4}, {}));
  EXPECT_TRUE(is_exact({3, 1, 1}, {}));  // in smallest spacings, too
  for (const Vec3& spacing : {Vec3{0.1, 0.1, 0.1}, {3, 3, 3}, {0.3, 0.6, 1.2}, {3, 4, 5}}) {
    EXPECT_FALSE(is_exact(spacing, {}));
  }
  for (const Vec3& origin : {Vec3{1, 0, 0}, {0, 0.1, 0}, {0, 0, -1e9}}) EXPECT_FALSE(is_exact({1, 1, 1}, origin));
}

}  // namespace
}  // namespace deliso
