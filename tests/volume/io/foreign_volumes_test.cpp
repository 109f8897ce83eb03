// Volumes that other tools have written: the samples, the map to the world, space and units are those that the tools
// read back themselves. The files lie in foreign/; where the tools are installed, others are written anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "delaunay/base/rng.h"
#include "tests/support/volume_files.h"
#include "volume/affine.h"
#include "volume/io/sha256.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

using Json = nlohmann::json;

const std::filesystem::path kForeign = std::filesystem::path(DELISO_SOURCE_DIR) / "tests/volume/io/foreign";

ReadOptions options_of(const Json& expected) {
  ReadOptions options;
  if (!expected["channel"].is_null()) options.channel = expected["channel"].get<std::uint64_t>();
  options.array = expected["array"];
  return options;
}

void expect_as_written(const std::filesystem::path& folder) {
  const Json all = Json::parse(read_text(folder / "expected.json"));
  EXPECT_GT(all.size(), 70u);
  for (const Json& expected : all) {
    const std::string name = expected["file"];
    SCOPED_TRACE(name);
    const Volume volume = read_placed_volume(folder / name, options_of(expected));
    EXPECT_EQ(volume.grid.dims(), expected["dims"].get<Dims>());
    EXPECT_EQ(sample_sha256(volume.grid), expected["sha256"]);
    EXPECT_EQ(volume.placement.space, expected["space"]);
    EXPECT_EQ(volume.placement.units, expected["units"]);
    const Affine map = composed(volume.placement.to_world, affine_of(volume.grid.spacing(), volume.grid.origin()));
    for (std::size_t row = 0; row < 3; ++row) {
      const Json& numbers = expected["index_to_world"][row];
      for (std::size_t column = 0; column < 3; ++column)
        EXPECT_NEAR(map.columns.at(column)[row], numbers[column].get<double>(), 1e-6) << row << column;
      EXPECT_NEAR(map.offset[row], numbers[3].get<double>(), 1e-6) << row;
    }
  }
}

TEST(ForeignVolumes, AreReadAsTheirToolsReadThem) { expect_as_written(kForeign); }

// Some programs write a sign into a voxel's size. It turned the axis round.
TEST(ForeignVolumes, ASignInANiftiVoxelSizeMirrorsNothing) {
  constexpr std::size_t kSizes = 76;  // pixdim: floats, beginning with that of the mirrored axis
  for (const std::string name : {"nifti_qform.nii", "nifti1_i2.nii"}) {
    std::string bytes = read_text(kForeign / name);
    const Volume plain = read_placed_volume(kForeign / name);
    for (const std::size_t axis : {std::size_t{1}, std::size_t{3}}) bytes[kSizes + 4 * axis + 3] ^= '\x80';
    const TemporaryFolder folder;
    write_text(folder / name, bytes);
    const Volume with_sign = read_placed_volume(folder / name);
    EXPECT_EQ(with_sign.grid.spacing(), plain.grid.spacing());
    EXPECT_EQ(with_sign.grid.origin(), plain.grid.origin());
    EXPECT_EQ(sample_sha256(with_sign.grid), sample_sha256(plain.grid));
    EXPECT_EQ(with_sign.placement.to_world, plain.placement.to_world);
  }
}

TEST(ForeignVolumes, WrittenAnewAreReadAsTheirToolsReadThem) {
  const std::string python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  if (std::system((python + " -c 'import mrcfile, nibabel, numpy, vtk' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "needs python3-nibabel, python3-numpy, python3-vtk9 and python3-mrcfile";
  const TemporaryFolder directory;
  for (const int seed : {2, 3}) {
    const std::string command = python + " " + (kForeign / "foreign_volumes.py").string() + " " +
                                directory.path().string() + " " + std::to_string(seed);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    expect_as_written(directory.path());
  }
}

// Reads a file, which may be refused, but in no other way than as bad input.
std::optional<Volume> read_or_refuse(const std::filesystem::path& path, const ReadOptions& options) {
  try {
    return read_placed_volume(path, options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(path.filename().string().substr(0, 3)), std::string::npos) << message;
    return std::nullopt;
  }
}

TEST(ForeignVolumes, CutOffAnywhereAreRefusedOrWhole) {
  const TemporaryFolder directory;
  std::filesystem::copy(kForeign, directory.path());
  for (const Json& expected : Json::parse(read_text(kForeign / "expected.json"))) {
    const std::string name = expected["file"];
    SCOPED_TRACE(name);
    const std::string whole = read_text(kForeign / name);
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 8) {
      write_text(directory / name, whole.substr(0, length));
      const auto volume = read_or_refuse(directory / name, options_of(expected));
      // A number in text that is cut off is another number.
      if (volume && name.find("_text") == std::string::npos) {
        EXPECT_EQ(sample_sha256(volume->grid), expected["sha256"]) << length;
      }
    }
    write_text(directory / name, whole);
  }
}

TEST(ForeignVolumes, WithBytesChangedAreReadOrRefused) {
  const TemporaryFolder directory;
  std::filesystem::copy(kForeign, directory.path());
  std::uint64_t seed = 1;
  for (const Json& expected : Json::parse(read_text(kForeign / "expected.json"))) {
    const std::string name = expected["file"];
    SCOPED_TRACE(name);
    const std::string whole = read_text(kForeign / name);
    Rng rng(seed++);
    for (int trial = 0; trial < 40; ++trial) {
      std::string bad = whole;
      // Half of the changes are in the header.
      const std::size_t range = trial % 2 == 0 ? std::min<std::size_t>(whole.size(), 400) : whole.size();
      for (std::uint64_t n = 1 + rng.next() % 3; n > 0; --n) bad[rng.next() % range] = static_cast<char>(rng.next());
      write_text(directory / name, bad);
      read_or_refuse(directory / name, options_of(expected));
    }
    write_text(directory / name, whole);
  }
}

TEST(ForeignVolumes, AreKnownByTheirContentAndPackedByTheirs) {
  const TemporaryFolder directory;
  for (const char* const name : {"nifti1_i2.nii", "nifti2_u8.nii.gz", "npy_f4_C.npy", "mrc_mode2.mrc", "meta_f4.mha"}) {
    if (!std::filesystem::exists(kForeign / name)) continue;
    std::filesystem::copy(kForeign / name, directory / "volume.dat", std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(read_volume(directory / "volume.dat").samples(), read_volume(kForeign / name).samples()) << name;
  }
}

}  // namespace
}  // namespace deliso
