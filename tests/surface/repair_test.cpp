// Repair as a whole, on a field that keeps it busy.
#include "surface/repair.h"

#include <gtest/gtest.h>

#include "surface/deliso.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

TEST(Repair, IsTheSameForAnyNumberOfThreads) {
  const auto scene = testing::noise_scene({10, 9, 8}, 4);
  const auto mesh = [&](int threads) {
    MeshingOptions options;
    options.threads = threads;
    options.parameters.repair.max_rounds = 2;
    options.keep_stage1_mesh = true;
    return mesh_isosurface(scene->grid, scene->isovalue, options);
  };
  const MeshingResult one = mesh(1);
  EXPECT_GE(one.repair.rounds, 1);
  for (const int threads : {2, 3, 5}) {
    const MeshingResult many = mesh(threads);
    EXPECT_EQ(one.stage1_mesh->points, many.stage1_mesh->points) << threads;
    EXPECT_EQ(one.stage1_mesh->triangles, many.stage1_mesh->triangles) << threads;
    EXPECT_EQ(one.mesh.points, many.mesh.points) << threads;
    EXPECT_EQ(one.mesh.triangles, many.mesh.triangles) << threads;
  }
}

}  // namespace
}  // namespace deliso
