// Which way meshes face that lie beside samples, where hardly a line along a grid edge tells.
#include <gtest/gtest.h>

#include <utility>

#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

using testing::sampled;

// No line along a grid edge may tell of passes this near to its samples.
TEST(FacingVotes, RefuseReversedMeshesBesideSamples) {
  for (const double height : {0.01, 5e-4, 1e-5}) {
    SCOPED_TRACE(height);
    const double least = height / (1 - height);
    const auto plane = [&](const Vec3& p) { return p.z < 4 ? 1.0 : (p.z > 4 ? -1.0 : least); };
    const auto plate = [&](const Vec3& p) {
      return p.z == 4 && p.x > 1 && p.x < 7 && p.y > 1 && p.y < 7 ? least : -1.0;
    };
    for (const ScalarGrid& grid : {sampled({9, 9, 9}, plane), sampled({9, 9, 9}, plate)}) {
      TriangleMesh mesh = mesh_isosurface(grid, 0, {}).mesh;
      EXPECT_TRUE(verify_mesh(mesh, grid, 0).proven);
      for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
      const Verification v = verify_mesh(mesh, grid, 0);
      EXPECT_FALSE(v.proven || v.orientation.pass);
    }
  }
}

// The walls of a closed volume lie beside samples; where a corner is cut off, a few lines tell, one way or another.
TEST(FacingVotes, RefuseReversedWalls) {
  for (const bool is_cut : {false, true}) {
    SCOPED_TRACE(is_cut);
    const auto box = [&](const Vec3& p) { return is_cut && p == Vec3{0, 0, 0} ? -1.0 : 1.0; };
    const ScalarGrid grid = sampled({6, 6, 6}, box);
    MeshingOptions options;
    options.parameters.boundary = Boundary::kClosed;
    TriangleMesh mesh = mesh_isosurface(grid, 0, options).mesh;
    const MeshedField field = meshed_field(grid, 0, {}, true, grid.spacing(), 1);
    EXPECT_TRUE(verify_mesh(mesh, field.grid, field.isovalue).proven);
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    EXPECT_FALSE(verify_mesh(mesh, field.grid, field.isovalue).orientation.pass);
  }
}

}  // namespace
}  // namespace deliso
