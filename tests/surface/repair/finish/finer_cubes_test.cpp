#include "surface/repair/finish/finer_cubes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "surface/certificate/certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// Component by component, in flat cells, too: right in topology, as near as asked for, and apart from each other.
TEST(FinerCubes, KeepAllThatIsPromised) {
  for (const double flat : {1.0, 0.15}) {
    Rng rng(5);
    const testing::Scene scene("noise", testing::noise_grid({6, 5, 5}, {1, flat, 1}, rng), 127.5);
    SurfaceMesh mesh;
    const auto count = static_cast<std::uint32_t>(scene.topology.components.size());
    for (std::uint32_t c = 0; c < count; ++c) {
      ASSERT_TRUE(append_finer_cubes(c, scene.surface(), 0.5, mesh)) << c;
    }
    const Promise promise{.max_distance = 0.5};
    const GeometryCheck check = check_geometry(mesh, scene.surface(), promise);
    EXPECT_TRUE(check.is_near());
    EXPECT_EQ(check.vertices_off, 0);
    EXPECT_EQ(check.reversed_components, 0);
    EXPECT_TRUE(check.off_box_edges.empty());
    const Verification verification =
        verify_mesh(to_world(mesh, *scene.isosurface), scene.grid, scene.isovalue, promise);
    EXPECT_TRUE(verification.proven);
    for (const std::string& failure : verification.failures) ADD_FAILURE() << failure;
  }
}

// Some means of two samples are the isovalue: another factor is taken.
TEST(FinerCubes, PassOverSamplesThatEqualTheIsovalue) {
  Rng rng(6);
  const testing::Scene scene("noise", testing::noise_grid({7, 7, 7}, {1, 1, 1}, rng), 127.5);
  bool has_mean = false;
  for (std::int32_t i = 0; i + 1 < 7; ++i) {
    for (std::int32_t jk = 0; jk < 49; ++jk) {
      has_mean = has_mean || scene.grid.at(i, jk % 7, jk / 7) + scene.grid.at(i + 1, jk % 7, jk / 7) == 255;
    }
  }
  ASSERT_TRUE(has_mean);
  SurfaceMesh mesh;
  for (std::uint32_t c = 0; c < scene.topology.components.size(); ++c) {
    EXPECT_TRUE(append_finer_cubes(c, scene.surface(), 1, mesh));
  }
  EXPECT_EQ(certify(to_world(mesh, *scene.isosurface), scene.topology).verdict, Verdict::kHomeomorphic);
}

}  // namespace
}  // namespace deliso
