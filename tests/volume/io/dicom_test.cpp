// A series of DICOM files that pydicom has written: slices in their order by place, rescaled samples, the map to the
// world. Skipped where ITK is not built in or python3-pydicom is not installed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/volume_files.h"
#include "volume/affine.h"
#include "volume/io/itk/itk_reader.h"
#include "volume/io/sha256.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

class Dicom : public testing::Test {
 protected:
  void SetUp() override {
#ifndef DELISO_HAS_ITK
    GTEST_SKIP() << "ITK is not built in (DELISO_ITK)";
#endif
    if (std::system("/usr/bin/python3 -c 'import numpy, pydicom' 2>/dev/null") != 0)
      GTEST_SKIP() << "needs python3-numpy and python3-pydicom";
  }
  void write(const std::string& how = "") const {
    const std::string script = std::string(DELISO_SOURCE_DIR) + "/tests/volume/io/foreign/dicom_series.py ";
    ASSERT_EQ(std::system(("/usr/bin/python3 " + script + folder_.path().string() + " " + how).c_str()), 0);
  }
  void expect_as_written() {
    const auto expected = nlohmann::json::parse(read_text(folder_ / "expected.json"));
    const Volume volume = read_placed_volume(folder_ / "series");
    EXPECT_EQ(volume.grid.dims(), expected["dims"].get<Dims>());
    EXPECT_EQ(sample_sha256(volume.grid), expected["sha256"]);
    EXPECT_EQ(volume.placement.space, "left-posterior-superior");
    EXPECT_EQ(volume.placement.units, "mm");
    EXPECT_EQ(volume.format, "DICOM, the longest of 2 series");
    const Affine map = composed(volume.placement.to_world, affine_of(volume.grid.spacing(), volume.grid.origin()));
    for (std::size_t row = 0; row < 3; ++row) {
      const auto& numbers = expected["index_to_world"][row];
      for (std::size_t column = 0; column < 3; ++column)
        EXPECT_NEAR(map.columns.at(column)[row], numbers[column].get<double>(), 1e-6) << row << column;
      EXPECT_NEAR(map.offset[row], numbers[3].get<double>(), 1e-6) << row;
    }
  }
  TemporaryFolder folder_;
};

TEST_F(Dicom, TheLongestSeriesOfAFolderIsAVolume) {
  write();
  expect_as_written();
}

// ITK would turn the axis upright and say nothing: the mesh was proven, and out of place.
TEST_F(Dicom, SlicesOfATiltedGantryStayWhereTheyAre) {
  write("tilted");
  expect_as_written();
}

TEST_F(Dicom, SlicesAtUnevenDistancesAreRefused) {
  write("uneven");
  expect_input_error([&] { read_placed_volume(folder_ / "series"); }, {"series", "slices", "0.9375", "2.8125"},
                     "series");
}

// GDCM fills up what is missing: the slice became a wall, and the mesh of it was proven.
TEST_F(Dicom, ASliceThatIsCutOffIsRefused) {
  for (const char* how : {"", "compressed"}) {
    std::filesystem::remove_all(folder_ / "series");
    write(how);
    expect_as_written();
    const std::filesystem::path slice = folder_ / "series/I2";
    const std::string whole = read_text(slice);
    // Also in the last byte of the pixels, or of the item that closes compressed ones.
    for (const std::size_t missing : {std::size_t{1}, std::size_t{9}, std::size_t{40}}) {
      write_text(slice, whole.substr(0, whole.size() - missing));
      expect_input_error([&] { read_placed_volume(folder_ / "series"); }, {"I2", "ends before its last pixel"}, "I2");
    }
  }
}

TEST_F(Dicom, ASeriesOfTwoThicknessesIsRefused) {
  write("divided");
  expect_input_error([&] { read_placed_volume(folder_ / "series"); }, {"series", "5 slices", "only 3", "thickness"},
                     "series");
}

TEST_F(Dicom, OneSliceIsNoVolume) {
  write();
  expect_input_error([&] { read_placed_volume(folder_ / "series/I0"); }, {"I0", "one slice", "folder"}, "I0");
}

}  // namespace
}  // namespace deliso
