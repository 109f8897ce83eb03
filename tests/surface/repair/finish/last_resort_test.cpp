#include "surface/repair/finish/last_resort.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "surface/certificate/exact_polygonization.h"
#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"
#include "tests/support/volume_files.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"
#include "volume/region.h"

namespace deliso {
namespace {

// Shells, one of which has no mesh, or has one twice.
TEST(LastResort, ReplacesComponentsWhosePiecesAreNotInPlace) {
  const auto scene = testing::field_scene("shells", 32);
  const ExactSurface surface = scene->surface();
  const ExactPolygonization cubes = exact_polygonization(surface);
  const std::size_t components = scene->topology.components.size();
  ASSERT_GT(components, 1u);
  for (const bool is_missing : {true, false}) {
    SurfaceMesh mesh;
    std::vector<bool> wanted(components, true);
    wanted[0] = !is_missing;
    append_pieces(cubes.mesh, cubes.component, wanted, mesh);
    if (!is_missing) append_pieces(cubes.mesh, cubes.component, {true}, mesh);
    MeshFaults faults;
    faults.places = assignment_faults(mesh, surface);
    EXPECT_EQ(is_missing ? faults.places.without : faults.places.repeated, std::vector<std::uint32_t>{0});
    EXPECT_EQ(faults.count(), 1);
    std::vector<bool> is_marked;
    EXPECT_EQ(replace_faulty_components(mesh, surface, faults, 1, is_marked), 1);
    EXPECT_TRUE(assignment_faults(mesh, surface).is_empty());
  }
}

// Marching cubes of noise, a part of which has no mesh: what takes its place is near, but for little.
TEST(LastResort, CubesWithDividedCellsAreNear) {
  const auto scene = testing::noise_scene({10, 10, 10}, 5);
  const ExactSurface surface = scene->surface();
  const Promise promise{.max_distance = 0.3, .within_cells = true};
  SurfaceMesh mesh = exact_polygonization(surface).mesh;
  MeshFaults faults;
  faults.geometry = check_geometry(mesh, surface, promise);
  faults.places = assignment_faults(mesh, surface);
  const std::int64_t before = faults.count();
  ASSERT_GT(before, 100);
  std::vector<bool> is_marked;
  EXPECT_GT(replace_by_nearer_cubes(mesh, surface, faults, {.max_distance = 0.3}, is_marked), 0);
  faults.geometry = check_geometry(mesh, surface, promise);
  faults.places = assignment_faults(mesh, surface);
  EXPECT_LT(10 * faults.count(), before);
  EXPECT_EQ(crossing_in_world(mesh, surface.isosurface, 1).crossing_pairs, 0);
}

// RefineGeom made a piece of one component grow onto another, and the piece of this one onto the first; a third had
// taken three vertices of it. Of ANEURISM's noise.
TEST(LastResort, MendsPiecesThatHaveGrownOntoOthers) {
  const auto data = data_directory();
  if (!data) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  const ScalarGrid all = read_volume(*data / "aneurism.nrrd");
  for (const char* region : {"178:192,51:85,107:150", "179:199,52:91,107:144"}) {
    const ScalarGrid grid = cropped(all, parse_region(region, "test"));
    const MeshingResult result = mesh_isosurface(grid, 0.5, {});
    EXPECT_TRUE(is_proven(result.certificate)) << region;
    EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used).proven) << region;
  }
}

// A byte volume whose steps leave a triangle too far, and whose component would be more than 2^25 finer samples.
TEST(LastResort, AComponentTooLargeForFinerCubesGetsMoreSamples) {
  MeshingOptions options;
  options.threads = 2;
  options.parameters.promise.max_distance = 0.2;
  const MeshingResult result = mesh_isosurface(generate_field("gyroid_scan", 160), 135.5, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_EQ(result.repair.components_polygonized, 0);
}

}  // namespace
}  // namespace deliso
