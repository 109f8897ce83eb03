// Triangles in necks and at edges where the isosurface nowhere faces as they do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

// No step was taken there, whatever stood before it: the smallest angles were 0.13 to 3.97 degrees.
TEST(Necks, TrianglesThatNothingFacesAreReplacedByBetterOnes) {
  for (const std::uint64_t seed : {9U, 43U, 61U, 115U, 125U, 127U}) {
    Rng rng(seed);
    const ScalarGrid grid = testing::sampled({9, 9, 9}, [&](const Vec3&) { return std::floor(256 * rng.uniform()); });
    const MeshingResult result = mesh_isosurface(grid, 127.5, {});
    EXPECT_TRUE(is_proven(result.certificate)) << seed;
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven) << seed;
    EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 8) << seed;
  }
}

}  // namespace
}  // namespace deliso
