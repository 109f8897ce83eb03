// The front of all formats: raw files, extensions, and the public volumes.
#include "volume/io/volume_file.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/volume_files.h"
#include "volume/io/sha256.h"

namespace deliso {
namespace {

template <class Sample>
class RawOfType : public testing::Test {};
using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(RawOfType, SampleTypes);

TYPED_TEST(RawOfType, FilesNamedAsInOpenSciVisReadBack) {
  const TemporaryFolder directory;
  const ScalarGrid grid({3, 4, 5}, random_samples<TypeParam>(60, 1));
  const std::string type = nrrd_type_name(sample_type(grid.samples()));
  const auto path = directory / ("my_volume_3x4x5_" + type + ".raw");
  write_volume(grid, path);
  EXPECT_EQ(std::filesystem::file_size(path), 60 * sizeof(TypeParam));
  EXPECT_EQ(read_volume(path).samples(), grid.samples());
}

TYPED_TEST(RawOfType, OptionsGoBeforeTheName) {
  // Written little endian, read with swapped byte order: swapping twice must give the samples back.
  const TemporaryFolder directory;
  const std::vector<TypeParam> samples = random_samples<TypeParam>(60, 2);
  std::vector<TypeParam> swapped = samples;
  swap_bytes(std::span(swapped));
  const auto bytes = std::as_bytes(std::span(swapped));
  write_text(directory / "v_9x9x9_uint8.RAW",
             "head" + std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  RawOptions options;
  options.dims = Dims{3, 4, 5};
  options.type = ScalarGrid({3, 4, 5}, samples).type_name();
  options.endian = kHostEndian == Endian::kLittle ? Endian::kBig : Endian::kLittle;
  options.spacing = {1, 2, 3};
  options.origin = {-1, -2, -3};
  options.header_bytes = 4;
  const ScalarGrid grid = read_volume(directory / "v_9x9x9_uint8.RAW", options);
  EXPECT_EQ(grid.samples(), Samples(samples));
  EXPECT_EQ(grid.dims(), (Dims{3, 4, 5}));
  EXPECT_EQ(grid.spacing(), (Vec3{1, 2, 3}));
  EXPECT_EQ(grid.origin(), (Vec3{-1, -2, -3}));
}

TEST(VolumeFile, AttributesInQuotesMayHoldTheEndOfATag) {
  const TemporaryFolder directory;
  for (const char quote : {'"', '\''}) {
    write_text(directory / "a.vti",
               std::string("<?xml version=\"1.0\"?>\n<!-- it's -->\n<VTKFile type=\"ImageData\">"
                           "<ImageData WholeExtent=\"0 1 0 1 0 1\"><Piece Extent=\"0 1 0 1 0 1\"><PointData>"
                           "<DataArray type=\"UInt8\" format=\"ascii\" Name=") +
                   quote + "a > b />" + quote +
                   ">1 2 3 4 5 6 7 8</DataArray></PointData></Piece></ImageData></VTKFile>\n");
    const ScalarGrid grid = read_volume(directory / "a.vti");
    EXPECT_EQ(grid.samples(), Samples(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  }
}

TEST(VolumeFile, InrKeysMayHaveBlanksAroundTheirSign) {
  const TemporaryFolder directory;
  std::string header =
      "#INRIMAGE-4#{\nXDIM = 2\nYDIM =2\n\tZDIM\t= 2 \r\nTYPE = unsigned fixed\nPIXSIZE= 8 bits\nCPU = decm\n"
      "VX = 2\nVY = 3\nVZ= 4\n";
  header.resize(256 - 4, '\n');
  write_text(directory / "a.inr", header + "##}\nabcdefgh");
  const ScalarGrid grid = read_volume(directory / "a.inr");
  EXPECT_EQ(grid.dims(), (Dims{2, 2, 2}));
  EXPECT_EQ(grid.spacing(), (Vec3{2, 3, 4}));
}

TEST(VolumeFile, NoFileIsCalledPackedThatIsNot) {
  const TemporaryFolder directory;
  const ScalarGrid grid({2, 3, 4}, random_samples<float>(24, 1));
  for (const char* name : {"a.nrrd.gz", "a_2x3x4_float32.raw.gz", "a.nrrd.GZ"}) {
    expect_input_error([&] { write_volume(grid, directory / name); }, {"expected .nrrd"}, name);
    EXPECT_FALSE(std::filesystem::exists(directory / name));
  }
}

TEST(VolumeFile, RawNamesMayHaveMoreWords) {
  const TemporaryFolder directory;
  const ScalarGrid grid({2, 3, 4}, random_samples<float>(24, 1));
  for (const char* name :
       {"2x3x4_float32.raw", "a_2x3x4_float32.raw", "a_b_2x3x4_float32_c.raw", "a.b_2x3x4_float.raw"}) {
    write_volume(grid, directory / name);
    EXPECT_EQ(read_volume(directory / name).samples(), grid.samples()) << name;
  }
}

TEST(VolumeFile, RawFilesThatCouldNotBeReadBackAreNotWritten) {
  const TemporaryFolder directory;
  const std::vector<float> samples(24);
  const ScalarGrid grid({2, 3, 4}, samples);
  expect_input_error([&] { write_volume(grid, directory / "v.raw"); }, {"v.raw", "_2x3x4_float.raw"});
  expect_input_error([&] { write_volume(grid, directory / "v_2x3x5_float.raw"); }, {"_2x3x4_float.raw"});
  expect_input_error([&] { write_volume(grid, directory / "v_2x3x4_double.raw"); }, {"_2x3x4_float.raw"});
  const ScalarGrid scaled_grid({2, 3, 4}, samples, {1, 1, 2});
  expect_input_error([&] { write_volume(scaled_grid, directory / "v_2x3x4_float.raw"); }, {"spacing", ".nrrd"});
  const ScalarGrid moved({2, 3, 4}, samples, {1, 1, 1}, {0, 0, 1});
  expect_input_error([&] { write_volume(moved, directory / "v_2x3x4_float.raw"); }, {"origin", ".nrrd"});
  expect_input_error([&] { write_volume(grid, directory / "v.nhdr"); }, {"\".nhdr\"", ".nrrd or .raw"});
  expect_input_error([&] { write_volume(grid, directory / "v.vtk"); }, {"\".vtk\""});
  EXPECT_EQ(directory.names().size(), 0u);
}

TEST(VolumeFile, ExtensionsInCapitalsCount) {
  const TemporaryFolder directory;
  const ScalarGrid grid({2, 3, 4}, random_samples<std::int16_t>(24, 1), {1, 2, 3});
  write_volume(grid, directory / "V.NRRD");
  EXPECT_EQ(read_volume(directory / "V.NRRD").samples(), grid.samples());
}

// What the header calls a dimension that is none is named, or the row and the axis.
TEST(VolumeFile, ADimensionThatIsNoneIsNamed) {
  const TemporaryFolder directory;
  std::string nifti(352, '\0');
  nifti[0] = 92, nifti[1] = 1;  // 348, the size of the header
  nifti[40] = 3, nifti[42] = 2, nifti[46] = 2, nifti[70] = 2, nifti[72] = 8;
  nifti.replace(344, 3, "n+1");
  const std::vector<std::array<std::string, 3>> files = {
      {"v.nii", nifti, "\"dim[2]\" is 0"},
      {"v.inr", "#INRIMAGE-4#{\nXDIM=2\nYDIM=0\nZDIM=2\nTYPE=unsigned fixed\n##}\n", "YDIM is 0"},
      {"v.pvm", "PVM\n2 4000000000 2\n1\n", "the dimension along y is 4000000000"},
      {"v.vtk", "# vtk DataFile Version 3.0\nv\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 0 2\n",
       "DIMENSIONS along y is 0"}};
  for (const auto& [name, content, part] : files) {
    write_text(directory / name, content);
    expect_input_error([&, file = directory / name] { read_volume(file); }, {part, "expected 2 to"});
  }
}

// Name and hash of the public volumes, from the list beside them.
std::map<std::string, std::string> published_hashes(const std::filesystem::path& data) {
  std::map<std::string, std::string> out;
  std::istringstream lines(read_text(data / "sha256.txt"));
  std::string hash;
  std::string name;
  std::string rest;
  while (lines >> hash >> name && std::getline(lines, rest)) out[name] = hash;
  return out;
}

TEST(PublicVolumes, SamplesHaveThePublishedHashes) {
  const auto data = data_directory();
  if (!data || !std::filesystem::exists(*data / "sha256.txt"))
    GTEST_SKIP() << "set DELISO_DATA to the directory of the public volumes";
  const auto hashes = published_hashes(*data);
  EXPECT_FALSE(hashes.empty());
  for (const auto& [name, hash] : hashes) {
    const auto path = *data / (name + ".nrrd");
    if (!std::filesystem::exists(path)) continue;
    const ScalarGrid grid = read_volume(path);
    EXPECT_EQ(sample_sha256(grid), hash) << name;
    EXPECT_EQ(grid.type_name(), "u8") << name;
  }
}

}  // namespace
}  // namespace deliso
