// Where ITK is built in: it reads the same of NIfTI, MetaImage and NRRD files as our own readers, and formats that we
// do not read.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "tests/support/volume_files.h"
#include "volume/io/itk/itk_reader.h"
#include "volume/io/volume_file.h"

#ifdef DELISO_HAS_ITK

namespace deliso {
namespace {

Affine map_in_lps(const Volume& volume) {
  const Placement placement = in_space(volume.placement, "LPS");
  return composed(placement.to_world, affine_of(volume.grid.spacing(), volume.grid.origin()));
}

void expect_equal(const Volume& own, const Volume& theirs, const std::string& name) {
  EXPECT_EQ(own.grid.dims(), theirs.grid.dims()) << name;
  EXPECT_EQ(own.grid.samples(), theirs.grid.samples()) << name;
  const Affine a = map_in_lps(own), b = map_in_lps(theirs);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_LT(distance(a.columns.at(n), b.columns.at(n)), 1e-5) << name;
  EXPECT_LT(distance(a.offset, b.offset), 1e-4) << name;
}

TEST(Itk, ReadsTheSameOfOurFormats) {
  const std::filesystem::path foreign = std::filesystem::path(DELISO_SOURCE_DIR) / "tests/volume/io/foreign";
  for (const char* const name : {"nifti1_i2.nii", "nifti1_big_i2.nii", "nifti1_f4.nii.gz", "nifti_qform.nii",
                                 "nifti_pair.hdr", "meta_u1.mha", "meta_i2.mha", "meta_f4_zlib.mhd"})
    expect_equal(read_placed_volume(foreign / name), read_by_itk(foreign / name, {}), name);
}

TEST(Itk, ReadsTheSameOfAskewVolumes) {
  const TemporaryFolder directory;
  std::string samples;
  for (int n = 0; n < 24; ++n) samples += static_cast<char>(n * 7);
  write_text(directory / "a.nrrd",
             "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nspace: left-posterior-superior\nencoding: raw\n"
             "space directions: (0.6,0.8,0) (0,0,-2) (-2.4,1.8,0)\nspace origin: (1,2,3)\n\n" +
                 samples);
  write_text(directory / "b.mha",
             "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = True\nCompressedData = False\n"
             "TransformMatrix = 0.6 0.8 0 0 0 -1 -0.8 0.6 0\nOffset = 1 2 3\nElementSpacing = 1 2 3\nDimSize = 2 3 4\n"
             "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
                 samples);
  const Volume first = read_placed_volume(directory / "a.nrrd");
  for (const char* const name : {"a.nrrd", "b.mha"}) {
    expect_equal(first, read_placed_volume(directory / name), name);
    expect_equal(first, read_by_itk(directory / name, {}), name);
  }
}

TEST(Itk, RefusesInOneSentence) {
  const TemporaryFolder directory;
  write_text(directory / "a.gipl", "no gipl");
  write_text(directory / "a.nii", "no nifti");
  for (const char* const name : {"a.gipl", "a.nii"})
    expect_input_error([&] { read_by_itk(directory / name, {}); }, {}, name);
}

// A header of 256 bytes, numbers in big endian: sizes, type of the samples, at the end a mark.
TEST(Itk, GiplFilesThatAreCutOffAreRefused) {
  const TemporaryFolder directory;
  std::string header(256, '\0');
  header.replace(0, 10, std::string("\0\2\0\3\0\4\0\1\0\10", 10));
  header.replace(10, 12, std::string("\x3f\x80\0\0\x3f\x80\0\0\x3f\x80\0\0", 12));
  header.replace(252, 4, std::string("\x2a\xe3\x89\xb8", 4));
  const std::string samples = "abcdefghijklmnopqrstuvwx";
  write_text(directory / "a.gipl", header + samples);
  const Volume volume = read_placed_volume(directory / "a.gipl");
  EXPECT_EQ(volume.grid.dims(), (Dims{2, 3, 4}));
  EXPECT_EQ(volume.grid.at(1, 2, 3), 'x');
  write_text(directory / "b.gipl", header + samples.substr(1));
  expect_input_error([&] { read_placed_volume(directory / "b.gipl"); }, {"data end", "the end of the samples"},
                     "b.gipl");
}

}  // namespace
}  // namespace deliso

#endif
