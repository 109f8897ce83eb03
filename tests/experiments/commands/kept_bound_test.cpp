// Stated errors, kept by what is written: `verify` finds nothing where `mesh` says so.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

class KeptBound : public ::testing::Test {
 protected:
  static std::string input(const std::string& name) {
    return std::string(DELISO_SOURCE_DIR) + "/tests/regression/" + name;
  }
  // Meshes it, and verifies what was written.
  void expect_proven(const std::string& volume, const std::string& isovalue, const std::string& name,
                     const std::vector<std::string>& more) {
    const std::string written = folder_ / name;
    std::vector<std::string> arguments = {"mesh", volume, "--isovalue", isovalue, "-o", written};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult made = run_deliso(arguments);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const ProgramResult verified = run_deliso({"verify", written, volume, "--isovalue", isovalue});
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
  }
  TemporaryFolder folder_;
};

// Its coordinates are about 4096, where floats are off by up to 2.4e-4.
TEST_F(KeptBound, OfWhatStlRoundsFarFromTheOrigin) {
  expect_proven(input("rounded_far.nrrd"), "0", "m.stl", {"--max-error", "0.004"});
}

// In the decimals that tell floats apart, read as doubles, three pairs of triangles crossed.
TEST_F(KeptBound, OfAsciiStl) {
  const std::string isovalue = "0.6376550179226826";
  expect_proven(input("ascii_floats.nrrd"), isovalue, "m.stl", {"--ascii", "--local-origin"});
}

// Rounded to the world, vertices on the walls lie within triangles that are not theirs: both commands say so.
TEST_F(KeptBound, IsNoneWhereTrianglesTouch) {
  const std::string volume = input("touching_on_walls.nrrd"), written = folder_ / "m.ply";
  const ProgramResult made = run_deliso({"mesh", volume, "--isovalue", "0.5", "--closed", "-o", written});
  EXPECT_EQ(made.exit_code, 1);
  EXPECT_NE(made.err.find("pairs of triangles touch beyond what they share"), std::string::npos) << made.err;
  const ProgramResult verified = run_deliso({"verify", written, volume, "--isovalue", "0.5"});
  EXPECT_EQ(verified.exit_code, 1);
  EXPECT_NE(verified.out.find("pairs of triangles touch"), std::string::npos) << verified.out;
}

// Twenty-eight small components lie in cells of the five that are kept.
TEST_F(KeptBound, InCellsThatComponentsLeftOutPassThrough) {
  expect_proven(input("cells_of_both.nrrd"), "0.55", "m.ply", {"--max-error", "0.06", "--keep-largest", "5"});
}

// Each of 108 components and more needs vertices of its own.
TEST_F(KeptBound, IsNotWidenedForANumberOfVerticesThatCannotBeReached) {
  std::string bytes = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 12 12\nencoding: raw\n\n";
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 12; ++j) {
      for (int i = 0; i < 12; ++i) bytes += static_cast<char>((i / 2 + j / 2 + k / 2) % 2);
    }
  }
  const std::string volume = folder_ / "checkers.nrrd";
  write_file(volume, bytes);
  const std::string report = folder_ / "r.json";
  expect_proven(volume, "0.5", "m.ply", {"--target-vertices", "100", "--report", report});
  const Json json = Json::parse(read_file(report));
  EXPECT_LT(json["promised_distance_voxels"], 2);
  EXPECT_LE(json["stages"]["decimate"]["largest_error_voxels"], json["promised_distance_voxels"]);
}

}  // namespace
}  // namespace deliso::testing
