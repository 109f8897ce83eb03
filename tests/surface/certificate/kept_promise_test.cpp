// Promises below a voxel: the mesher measures within cells then, as the verification does.
#include <gtest/gtest.h>

#include "surface/certificate/certificate.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

// Ripples and noise, which have parts of the isosurface within cells that are farther from the mesh than its crossings
// with the edges of the grid. The mesh was called proven, and was not.
TEST(KeptPromise, BelowAVoxelIsVerified) {
  const ScalarGrid fields[] = {generate_field("marschner_lobb", 16), testing::noise_scene({9, 9, 9}, 5)->grid};
  for (const ScalarGrid& grid : fields) {
    MeshingOptions options;
    options.threads = 2;
    options.parameters.promise.max_distance = 0.2;
    const auto [low, high] = grid.range();
    const MeshingResult result = mesh_isosurface(grid, (low + high) / 2, options);
    EXPECT_TRUE(is_proven(result.certificate));
    EXPECT_EQ(result.promised_distance, 0.2);
    EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 9.9);  // steps that brought it near left 0.4 and less
    const Promise promise{.max_distance = 0.2};
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used, promise).proven);
  }
}

}  // namespace
}  // namespace deliso
