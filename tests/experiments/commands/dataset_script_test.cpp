// experiments/datasets.sh, in a checkout of its own with tiny volumes; and experiments/reproduce.sh.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/run_examples.h"
#include "volume/io/sha256.h"
#include "volume/io/volume_file.h"
#include "volume/scalar_grid.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

class DatasetScript : public ::testing::Test {
 protected:
  DatasetScript() {
    const fs::path own = fs::path(DELISO_SOURCE_DIR) / "experiments";
    for (const char* folder : {"experiments", "configs/reference", "downloads/deep", "data"}) {
      fs::create_directories(folder_ / std::string(folder));
    }
    for (const char* name : {"datasets.sh", "packages.sh"}) {
      fs::copy_file(own / name, folder_ / (std::string("experiments/") + name));
    }
    // A scan of three slices, of which the paper's volume has two slices of zeros before and one behind.
    core_ = "abcdefghijkl";
    whole_ = std::string(8, '\0') + core_ + std::string(4, '\0');
    write_file(folder_ / "configs/reference/datasets.json",
               R"({"datasets": [
                 {"name": "SCAN 1", "file": "scan.nrrd", "isovalue": 1, "sha256": ")" +
                   hash(whole_, {2, 2, 6}) + R"(", "get": "at the desk"},
                 {"name": "SCAN 2", "file": "scan.nrrd", "isovalue": 2, "sha256": ")" +
                   hash(whole_, {2, 2, 6}) + R"(", "get": "at the desk"},
                 {"name": "OTHER", "file": "other.nrrd", "isovalue": 1, "sha256": ")" +
                   hash("01234567", {2, 2, 2}) + R"(", "get": "behind the door"}]})");
    write_file(folder_ / "configs/reference/volumes.json",
               R"({"volumes": {"scan.nrrd": {"dims": [2, 2, 6], "core_sha256": ")" + hash(core_, {2, 2, 3}) +
                   R"(", "slices_before": 2}, "other.nrrd": {"dims": [2, 2, 2]}}})");
  }

  static std::string hash(const std::string& samples, const std::array<std::int32_t, 3>& dims) {
    return sample_sha256(grid_of(samples, dims));
  }
  static ScalarGrid grid_of(const std::string& samples, const std::array<std::int32_t, 3>& dims) {
    return {dims, std::vector<std::uint8_t>(samples.begin(), samples.end())};
  }
  int run() {
    const std::string command = "'" + (folder_ / "experiments/datasets.sh") + "' '" + (folder_ / "downloads") +
                                "' --data '" + (folder_ / "data") + "' > '" + (folder_ / "out.txt") + "' 2>&1";
    const int status = std::system(command.c_str());
    said_ = read_file(folder_ / "out.txt");
    return status;
  }

  TemporaryFolder folder_;
  std::string core_, whole_, said_;
};

TEST_F(DatasetScript, TellsVolumesByTheirSamplesAndPadsThem) {
  // Raw samples with one slice of zeros of their own, and a packed NRRD, both under names that tell nothing.
  write_file(folder_ / "downloads/deep/readme.txt", std::string(4, '\0') + core_);
  write_volume(grid_of("01234567", {2, 2, 2}), folder_ / "downloads/a.nrrd", NrrdEncoding::kGzip);
  fs::rename(folder_ / "downloads/a.nrrd", folder_ / "downloads/b.dat");
  write_file(folder_ / "downloads/noise", "no volume at all");
  EXPECT_EQ(run(), 0) << said_;
  EXPECT_NE(said_.find("SCAN 1, SCAN 2: "), std::string::npos) << said_;
  EXPECT_NE(said_.find("padded with zeros"), std::string::npos);
  EXPECT_EQ(sample_sha256(read_volume(folder_ / "data/scan.nrrd")), hash(whole_, {2, 2, 6}));
  EXPECT_EQ(read_volume(folder_ / "data/scan.nrrd").dims(), (std::array<std::int32_t, 3>{2, 2, 6}));
  EXPECT_EQ(sample_sha256(read_volume(folder_ / "data/other.nrrd")), hash("01234567", {2, 2, 2}));
  // What is there is left as it is.
  const auto before = fs::last_write_time(folder_ / "data/scan.nrrd");
  EXPECT_EQ(run(), 0) << said_;
  EXPECT_EQ(fs::last_write_time(folder_ / "data/scan.nrrd"), before);
}

TEST_F(DatasetScript, SaysWhatIsMissingAndWhatIsWrong) {
  write_volume(grid_of("76543210", {2, 2, 2}), folder_ / "data/other.nrrd");
  EXPECT_NE(run(), 0);
  EXPECT_NE(said_.find("SCAN 1, SCAN 2: missing; at the desk"), std::string::npos) << said_;
  EXPECT_NE(said_.find("OTHER: " + (folder_ / "data/other.nrrd") + " is another volume"), std::string::npos) << said_;
}

// With no section wanted: what is around the tables and figures themselves.
TEST(ReproduceScript, SaysWhereItRanAndWhatItLeftOut) {
  const TemporaryFolder folder;
  const std::string command =
      "OUT='" + (folder / "out") + "' DELISO='" DELISO_PROGRAM "' DELISO_DATA='" + (folder / "data") +
      "' DELISO_ONLY=none '" DELISO_SOURCE_DIR "/experiments/reproduce.sh' > '" + (folder / "said") + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_file(folder / "said");
  const std::string environment = read_file(folder / "out/environment.txt");
  for (const char* part : {"\ncommit ", "\ncompiler ", "\nprocessor ", "\nkernel ", "\ncheckout "}) {
    EXPECT_NE(environment.find(part), std::string::npos) << part;
  }
  // The pages are copies with the sections that would be made, and each of these is accounted for.
  const std::string page = read_file(folder / "out/pages/configs/paper/README.md");
  EXPECT_EQ(page, read_file(fs::path(DELISO_SOURCE_DIR) / "configs/paper/README.md"));
  const std::string left_out = read_file(folder / "out/left_out.txt");
  for (const char* part : {"table table3: ", "table ablations: ", "table compare_fields_error: ", "figures: "}) {
    EXPECT_NE(left_out.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace deliso::testing
