// The program of another compiler, named by DELISO_OTHER_PROGRAM, makes the same meshes to the last byte.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/program_runner.h"
#include "tests/support/volume_files.h"

namespace deliso::testing {
namespace {

struct VolumeAtIsovalue {
  const char* file;
  const char* isovalue;
  const char* region = nullptr;
};

std::ostream& operator<<(std::ostream& out, const VolumeAtIsovalue& pair) {
  return out << pair.file << " at " << pair.isovalue;
}

class OtherCompiler : public ::testing::TestWithParam<VolumeAtIsovalue> {};

TEST_P(OtherCompiler, MakesTheSameMesh) {
  const char* const other = std::getenv("DELISO_OTHER_PROGRAM");
  if (other == nullptr || *other == '\0') GTEST_SKIP() << "set DELISO_OTHER_PROGRAM to the program of another compiler";
  const std::optional<std::filesystem::path> data = data_directory();
  if (!data) GTEST_SKIP() << "set DELISO_DATA to the directory of the public volumes";
  const std::filesystem::path volume = *data / GetParam().file;
  if (!std::filesystem::exists(volume)) GTEST_SKIP() << volume << " is not there";

  const TemporaryFolder folder;
  const auto mesh = [&](const std::filesystem::path& program, const std::string& name) {
    std::vector<std::string> words{
        "mesh", volume.string(), "--isovalue", GetParam().isovalue, "-o", folder / name, "--threads", "2", "--quiet"};
    if (GetParam().region != nullptr) words.insert(words.end(), {"--region", GetParam().region});
    return run_program_at(program, words);
  };
  const ProgramResult ours = mesh(DELISO_PROGRAM, "ours.ply");
  const ProgramResult others = mesh(other, "others.ply");
  ASSERT_TRUE(ours.exit_code == 0 || ours.exit_code == 1) << ours.err;  // proven or not, there is a mesh
  ASSERT_EQ(others.exit_code, ours.exit_code) << others.err;
  // Not EXPECT_EQ, which would print megabytes.
  EXPECT_TRUE(read_file(folder / "others.ply") == read_file(folder / "ours.ply"));
}

// The other program may have sanitizers and take some twenty times as long: regions of the large volumes.
INSTANTIATE_TEST_SUITE_P(PublicVolumes, OtherCompiler,
                         ::testing::Values(VolumeAtIsovalue{"engine.nrrd", "40.1", "60:140,60:160,30:90"},
                                           VolumeAtIsovalue{"baby.nrrd", "35.8", "40:170,40:180,20:97"},
                                           VolumeAtIsovalue{"aneurism.nrrd", "124.6", "100:160,80:160,60:120"},
                                           VolumeAtIsovalue{"fuel.nrrd", "70.1"},
                                           VolumeAtIsovalue{"hydrogen_atom.nrrd", "20.1"}));

INSTANTIATE_TEST_SUITE_P(Heavy, OtherCompiler,
                         ::testing::Values(VolumeAtIsovalue{"engine.nrrd", "40.1"},
                                           VolumeAtIsovalue{"baby.nrrd", "35.8"},
                                           VolumeAtIsovalue{"baby.nrrd", "131.6"},
                                           VolumeAtIsovalue{"aneurism.nrrd", "124.6"},
                                           VolumeAtIsovalue{"leg.nrrd", "22.1"}));

}  // namespace
}  // namespace deliso::testing
