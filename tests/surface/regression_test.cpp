// Inputs that once went wrong, from tests/regression, and fields made like them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/intersection/self_intersection.h"
#include "surface/verification/verification.h"
#include "tests/support/surface_fields.h"
#include "volume/io/volume_file.h"
#include "volume/topology/critical_points.h"

namespace deliso {
namespace {

const std::filesystem::path kInputs = std::filesystem::path(DELISO_SOURCE_DIR) / "tests" / "regression";

// Samples from 1e-300 to 1e300 give surface points nearer to the box than exact predicates reach.
TEST(Regression, SamplesOfAllMagnitudesMeshWithoutACrash) {
  const ScalarGrid grid = read_volume(kInputs / "all_magnitudes.nrrd");
  for (const double isovalue : {0.5, 0.0}) {
    const MeshingResult result = mesh_isosurface(grid, isovalue, {});
    EXPECT_FALSE(result.mesh.triangles.empty());
    for (const Vec3& p : result.mesh.points) EXPECT_TRUE(is_finite(p));
  }
}

// Values and gradients between such samples are infinite or no numbers: meshes were coarse and off the surface, and the
// check of a mesh looked beyond the volume.
TEST(Regression, OverflowingDifferencesAreRefusedAndCheckedWithoutACrash) {
  const ScalarGrid grid = read_volume(kInputs / "overflowing_differences.nrrd");
  EXPECT_THROW(mesh_isosurface(grid, 0.5, {}), InputError);
  std::vector<double> scaled;
  for (const double sample : std::get<SampleArray<double>>(grid.samples())) scaled.push_back(1e-300 * sample);
  const MeshingResult result = mesh_isosurface(ScalarGrid(grid.dims(), scaled), 0.5, {});
  ASSERT_FALSE(result.mesh.triangles.empty());
  const Verification verification = verify_mesh(result.mesh, grid, 0.5);
  EXPECT_EQ(verification.topology.verdict, result.certificate.verdict);
}

// An isovalue that is the value of a saddle but for rounding: two sheets, or two arms of one, come within 1e-8 voxels.
TEST(Regression, NecksAsThinAsRoundingKeepTheirTopology) {
  int tried = 0;
  for (std::uint64_t seed = 1; tried < 6; ++seed) {
    Rng rng(seed);
    const ScalarGrid grid = testing::noise_grid({7, 7, 7}, {1, 1, 1}, rng);
    std::vector<CriticalPoint> saddles;
    append_critical_points(grid.cell(3, 3, 3), saddles);
    for (const CriticalPoint& saddle : saddles) {
      const double isovalue = saddle.value;
      if (saddle.face < 0 || isovalue == std::round(isovalue)) continue;
      ++tried;
      const MeshingResult result = mesh_isosurface(grid, isovalue, {});
      EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic) << "seed " << seed << " isovalue " << isovalue;
      EXPECT_EQ(self_intersections(result.mesh).crossing_pairs, 0) << "seed " << seed << " isovalue " << isovalue;
      break;
    }
  }
}

// Necks that the mesh cuts: a blob is a stray piece then, and what is left has the right topology all the same. Of some
// blobs the triangulation has few samples; and slivers of endless circumradius seemed to cover others.
TEST(Regression, NoPartOfTheSurfaceIsLeftOut) {
  for (const char* const name : {"cut_neck_0.nrrd", "cut_neck_1.nrrd", "cut_neck_2.nrrd"}) {
    const ScalarGrid grid = read_volume(kInputs / name);
    const MeshingResult result = mesh_isosurface(grid, 200.5, {});
    const Verification verification = verify_mesh(result.mesh, grid, 200.5);
    EXPECT_TRUE(verification.proven) << name;
    EXPECT_LT(verification.distance.isosurface_to_mesh.max_voxels, 0.9) << name;
  }
}

// Copies of a vertex that cannot be moved apart made triangles cross, and the whole component came from marching cubes.
// It comes from there still where repair gives it up; not where an error is stated.
TEST(Regression, TrianglesThatCrossAreMendedByMoreSamples) {
  const ScalarGrid grid = read_volume(kInputs / "crossing_copies.nrrd");
  for (const bool is_sized : {false, true}) {
    MeshingOptions options;
    if (is_sized) options.parameters.size.max_error = 0.9;
    const MeshingResult result = mesh_isosurface(grid, 0.5, options);
    EXPECT_EQ(result.repair.components_given_up, is_sized ? 0 : 1);
    EXPECT_EQ(result.repair.components_polygonized, result.repair.components_given_up);
    EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic);
    EXPECT_EQ(self_intersections(result.mesh).crossing_pairs, 0);
  }
}

// A plate with one smooth side and a rough one: the tip of a finger stood out of stage 2's mesh by more than a voxel.
TEST(Regression, NoFingerStandsOutOfTheMesh) {
  Rng rng(214);
  const auto noise = [&] { return 20 * (2 * rng.uniform() - 1); };
  const std::array<double, 11> levels = {100, 115, 132, 148, 215, 255, 199};
  const std::int32_t size = 32;
  std::vector<float> samples;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (std::int32_t i = 0; i < size * size; ++i) {
      const double rough = noise();
      samples.push_back(static_cast<float>(k < 4 ? levels[k] + rough : levels[k]));
    }
  }
  const ScalarGrid grid({size, size, static_cast<std::int32_t>(levels.size())}, std::move(samples));
  MeshingOptions options;
  options.parameters.stage2.r_min = 0.026;
  const MeshingResult result = mesh_isosurface(grid, 150.2, options);
  const Verification verification = verify_mesh(result.mesh, grid, 150.2);
  EXPECT_TRUE(verification.proven);
  EXPECT_LT(verification.distance.isosurface_to_mesh.max_voxels, 0.9);
}

// Each was not proven once.
struct Input {
  const char* name;
  double isovalue;
  Boundary boundary = Boundary::kOpen;
  friend std::ostream& operator<<(std::ostream& out, const Input& input) { return out << input.name; }
};
// A mask far from the origin: a sheet lay back on itself but for the last bit, and crossed itself where coordinates
// were rounded. What is called proven has to be apart in the volume's own coordinates.
TEST(Regression, SheetsThatRoundingMakesCrossAreNotCalledProven) {
  const ScalarGrid grid = read_volume(kInputs / "rounded_fold.nrrd");
  const MeshingResult result = mesh_isosurface(grid, 0.5, {});
  const bool is_apart = self_intersections(result.mesh).crossing_pairs == 0;
  EXPECT_EQ(is_proven(result.certificate), is_apart);
  EXPECT_EQ(verify_mesh(result.mesh, grid, 0.5).proven, is_apart);
}

// A slab had used up its share of the vertices, and what it had made was compared with nothing: 18 pairs crossed. The
// run itself was not stopped, and says what it is.
TEST(Regression, ASlabWithoutVerticesLeftIsCompared) {
  const ScalarGrid grid = read_volume(kInputs / "share_of_a_slab.nrrd");
  MeshingOptions options;
  options.parameters.size.max_edge = 0.45;
  options.parameters.shape.rounds = 0;
  options.parameters.budget.max_vertices = 58095;
  const MeshingResult result = mesh_isosurface(grid, 0.06, options);
  ASSERT_LT(result.mesh.points.size(), 58095U);
  EXPECT_EQ(self_intersections(result.mesh.points, result.mesh.triangles, 1).crossing_pairs, 0);
  EXPECT_EQ(verify_mesh(result.mesh, grid, result.isovalue_used).proven, is_proven(result.certificate));
}

class ProvenInput : public ::testing::TestWithParam<Input> {};

TEST_P(ProvenInput, StaysSo) {
  const auto& [name, isovalue, boundary] = GetParam();
  const ScalarGrid grid = read_volume(kInputs / name);
  MeshingOptions options;
  options.parameters.boundary = boundary;
  options.parameters.r_min_of = RMinOf::kBox;  // the default when they were found: small volumes are refined far more
  const MeshingResult result = mesh_isosurface(grid, isovalue, options);
  const MeshedField field = meshed_field(grid, isovalue, {}, boundary == Boundary::kClosed, grid.spacing(), 1);
  const Verification verification = verify_mesh(result.mesh, field.grid, field.isovalue);
  EXPECT_TRUE(verification.proven);
  for (const std::string& failure : verification.failures) ADD_FAILURE() << failure;
}

INSTANTIATE_TEST_SUITE_P(
    Regression, ProvenInput,
    ::testing::Values(
        // The vertex of a subdivided edge was placed far away, beyond another sheet.
        Input{"far_home.nrrd", 127.5},
        // A small component lost the crossings on one side, and its orientation was reversed.
        Input{"half_speck.nrrd", 128.9},
        // Tips of very thin fingers: samples below them were left out although they were near enough themselves.
        Input{"left_out_tip_0.nrrd", 128.1}, Input{"left_out_tip_1.nrrd", 128.9},
        // The vertex of a subdivided edge stayed off the surface, because triangles would have crossed at every
        // position on it.
        Input{"off_surface_edge.nrrd", 128.2},
        // Near the saddle of a face, the check did not find the surface from which a vertex had been moved by less than
        // 1e-3.
        Input{"face_saddle.nrrd", 128.2},
        // Samples of mixed magnitudes. The check stepped over a very thin layer behind a grid face.
        Input{"mixed_magnitudes_0.nrrd", 0},
        // It took a needle around a grid edge for reversed: near the needle the gradient belongs to other parts.
        Input{"mixed_magnitudes_1.nrrd", 0},
        // Copies of vertices that were moved apart (by less than 1e-3) turned a small component inside out.
        Input{"mixed_magnitudes_2.nrrd", 0},
        // One of two disks was right, and meshed once more as a part of the other, which the counts did not show.
        Input{"swallowed_disk.nrrd", 0.1},
        // A wide triangle spans the hollow between the arms of a corner piece, so its centroid is nearest to another
        // part.
        Input{"mixed_magnitudes_3.nrrd", 0},
        // Cubes with divided cells had a small component that seemed reversed, and finer ones began from these.
        Input{"faulty_divided_cubes.nrrd", 0},
        // The stage `shape` cut bubbles of a few hundredths of a voxel so that the sample inside them was outside.
        Input{"lone_sample_0.nrrd", 0.18736082051919575},
        Input{"lone_sample_1.nrrd", 0.4085083012745886, Boundary::kClosed},
        // Sheets within a hundredth of a voxel of samples. The check took a component for reversed because the mesh
        // passes samples on their other side, by less than that.
        Input{"near_samples_0.nrrd", 2, Boundary::kClosed}, Input{"near_samples_1.nrrd", 2, Boundary::kClosed},
        // Where masks are plane the surface was folded back on itself; rounded to world coordinates, the folds crossed.
        Input{"folded_mask_0.nrrd", 0.5}, Input{"folded_mask_1.nrrd", 0.5}, Input{"folded_mask_2.nrrd", 0.5},
        // Samples of 1e-17 where terms cancel, on planes: crossings at each of them were one point, and triangles there
        // had no area.
        Input{"zero_planes_0.nrrd", 0}, Input{"zero_planes_1.nrrd", 0}, Input{"zero_planes_2.nrrd", 0},
        // A hair above the lowest sample: the isovalue was lowered towards the layer that closes the solid.
        Input{"near_the_lowest.nrrd", -0.999999999, Boundary::kClosed},
        // Cells 50 times as long as wide: finer cubes and the stage `shape` take longer than all else, and under a
        // fuzzer a minute.
        Input{"long_cells.nrrd", 3, Boundary::kClosed}),
    [](const auto& input) {
      const std::string name = input.param.name;
      return name.substr(0, name.find('.'));
    });

}  // namespace
}  // namespace deliso
