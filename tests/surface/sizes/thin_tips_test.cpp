// A stated error where the isosurface has folds and tips of thin fingers, and the angles that decimation leaves there.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>

#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/verification/verification.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"
#include "volume/region.h"

namespace deliso {
namespace {

const std::filesystem::path kInputs = std::filesystem::path(DELISO_SOURCE_DIR) / "tests" / "regression";

// Rings close to the sampling limit end in fingers a tenth of a voxel wide.
struct Case {
  const char* field;
  std::int32_t size;
  double isovalue, max_error;
  const char* region;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.field << " " << c.isovalue << " at " << c.max_error;
  }
};

class StatedError : public ::testing::TestWithParam<Case> {};

// Of the first ones a few tips were missed, and finer cubes took the place of all: up to five times the vertices before
// decimation, and angles below 1 degree after it. On smooth fields angles of 3 degrees were left.
TEST_P(StatedError, IsKeptWithoutFinerCubesAndWithGoodAngles) {
  const Case& c = GetParam();
  const ScalarGrid grid = cropped(generate_field(c.field, c.size), parse_region(c.region, "test"));
  MeshingOptions options;
  options.parameters.size.max_error = c.max_error;
  const MeshingResult result = mesh_isosurface(grid, c.isovalue, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_LE(result.promised_distance, c.max_error);
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used, {.max_distance = c.max_error}).proven);
  EXPECT_EQ(result.repair.components_polygonized, 0);
  EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 8);
}

INSTANTIATE_TEST_SUITE_P(ThinTips, StatedError,
                         ::testing::Values(Case{"marschner_lobb", 41, 100.1, 0.25, "0:14,5:19,16:30"},
                                           Case{"marschner_lobb", 41, 127.5, 0.25, "0:12,0:12,14:28"},
                                           Case{"marschner_lobb", 41, 127.5, 0.1, "2:14,26:38,15:28"},
                                           Case{"gyroid_ball", 48, 0, 0.1, ":,:,:"},
                                           Case{"gyroid_ball", 64, 0.1, 0.1, ":,:,:"}));

// Of a region that lies off the origin, steps along straight creases left triangles that crossed when rounded, and
// finer cubes took the place of all: 47,212 vertices.
TEST(RoundedError, IsKeptWhereDecimationLeavesTrianglesThatCrossWhenRounded) {
  const ScalarGrid grid = cropped(generate_field("marschner_lobb", 41), parse_region("0:13,9:22,17:30", "test"));
  MeshingOptions options;
  options.parameters.size.max_error = 0.07;
  const MeshingResult result = mesh_isosurface(grid, 100.1, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_TRUE(verify_mesh(result.mesh, grid, result.isovalue_used, {.max_distance = 0.07}).proven);
  EXPECT_EQ(result.repair.components_polygonized, 0);
}

// Triangles that no step brought near let stage 1 run again seven times as long, where a point off them does.
TEST(FarTriangles, GetAPointOffThem) {
  const ScalarGrid grid = read_volume(kInputs / "far_triangles.nrrd");
  MeshingOptions options;
  const std::int64_t once = mesh_isosurface(grid, 4, options).recover.insertions;
  options.parameters.size.max_error = 0.2;
  const MeshingResult result = mesh_isosurface(grid, 4, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_LT(result.recover.insertions, 3 * once);
}

// Where tips are missed, as at first with an error this small, stage 1 has to run again. Here steps reach all of them:
// in several rounds, in other places than the nearest triangle, in faces of the box, and where no boundary edge has
// been divided into a fan of needles.
struct TipsCase {
  const char* file;  // in tests/regression; none: marschner_lobb
  double isovalue, max_error;
  const char* region;

  friend std::ostream& operator<<(std::ostream& out, const TipsCase& c) {
    return out << c.file << " " << c.isovalue << " " << c.region;
  }
};

class Tips : public ::testing::TestWithParam<TipsCase> {};

TEST_P(Tips, AreReachedWithoutStageOneAgain) {
  const TipsCase& c = GetParam();
  const std::string file = c.file;
  const ScalarGrid grid = cropped(file.empty() ? generate_field("marschner_lobb", 41) : read_volume(kInputs / file),
                                  parse_region(c.region, "test"));
  MeshingOptions options;
  const std::int64_t once = mesh_isosurface(grid, c.isovalue, options).recover.insertions;
  options.parameters.size.max_error = c.max_error;
  const MeshingResult result = mesh_isosurface(grid, c.isovalue, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_EQ(result.recover.insertions, once);
}

INSTANTIATE_TEST_SUITE_P(Fields, Tips,
                         ::testing::Values(TipsCase{"", 127.5, 0.1, "7:20,15:28,15:28"},
                                           TipsCase{"tip_in_face.nrrd", 0.5, 0.05, ":,:,:"},
                                           TipsCase{"boundary_needles.nrrd", 0.309, 0.05, ":,:,:"}));
INSTANTIATE_TEST_SUITE_P(HeavyFields, Tips,
                         ::testing::Values(TipsCase{"", 100.1, 0.07, "6:19,0:13,15:28"},
                                           TipsCase{"", 100.1, 0.1, "19:32,10:23,16:29"}));

}  // namespace
}  // namespace deliso
