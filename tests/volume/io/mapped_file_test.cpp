// Volumes that are mapped into memory: the same samples and the same errors as when they are read, and nothing mapped
// that cannot be used as it lies in the file.
#include "volume/io/base/mapped_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/volume_files.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/base/input_file.h"
#include "volume/io/base/sample_reader.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

constexpr std::uint64_t kAlways = 0;
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

bool is_mapped(const Samples& samples) {
  return visit_samples(samples, [](const auto& s) { return s.is_mapped(); });
}

template <class Sample>
std::string text_of(const std::vector<Sample>& samples) {
  const auto bytes = std::as_bytes(std::span(samples));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string bytes_of(const Samples& samples) {
  const auto bytes = sample_bytes(samples);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Samples read(const std::filesystem::path& path, const SampleLayout& layout, std::uint64_t mapped_from) {
  InputFile file(path);
  return read_samples(file, layout, mapped_from);
}

// Eight bytes.
const SampleLayout kEight = [] {
  SampleLayout layout;
  layout.dims = {2, 2, 2};
  return layout;
}();

template <class Sample>
class MappedSamplesOfType : public testing::Test {};
using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(MappedSamplesOfType, SampleTypes);

TYPED_TEST(MappedSamplesOfType, AreThoseThatAreRead) {
  const TemporaryFolder directory;
  const std::vector<TypeParam> samples = random_samples<TypeParam>(60, 3);
  SampleLayout layout;
  layout.type = static_cast<StoredType>(sample_type(Samples(samples)));
  layout.dims = {3, 4, 5};
  for (std::uint64_t before = 0; before <= 16; ++before) {
    SCOPED_TRACE(before);
    write_text(directory / "v", std::string(before, 'x') + text_of(samples));
    for (const Endian endian : {Endian::kLittle, Endian::kBig}) {
      layout.endian = endian;
      layout.skipped_bytes = before;
      const Samples mapped = read(directory / "v", layout, kAlways);
      EXPECT_EQ(bytes_of(mapped), bytes_of(read(directory / "v", layout, kNever)));  // there may be NaN among them
      EXPECT_EQ(is_mapped(mapped),
                before % sizeof(TypeParam) == 0 && (sizeof(TypeParam) == 1 || endian == kHostEndian));
    }
  }
  // Reversed samples have to be moved.
  write_text(directory / "v", text_of(samples));
  layout.endian = kHostEndian;
  layout.skipped_bytes = 0;
  layout.flipped = {false, true, false};
  const Samples flipped = read(directory / "v", layout, kAlways);
  EXPECT_FALSE(is_mapped(flipped));
  EXPECT_NE(flipped, Samples(samples));
}

TYPED_TEST(MappedSamplesOfType, LieOnTheirSizeInFilesThatWeWrite) {
  const TemporaryFolder directory;
  const ScalarGrid grid({3, 4, 5}, random_samples<TypeParam>(60, 4), {1, 0.125, 3e-7}, {0, 1, -1.0 / 7});
  write_nrrd(grid, directory / "v.nrrd", NrrdEncoding::kRaw);
  EXPECT_EQ((std::filesystem::file_size(directory / "v.nrrd") - 60 * sizeof(TypeParam)) % 8, 0u);
  const ScalarGrid back = read_nrrd(directory / "v.nrrd");
  EXPECT_EQ(back.samples(), grid.samples());
  EXPECT_EQ(back.origin(), grid.origin());
}

TEST(MappedSamples, OutliveTheFileTheyCameFrom) {
  const TemporaryFolder directory;
  write_text(directory / "v", "abcdefgh");
  const Samples samples = read(directory / "v", kEight, kAlways);
  std::filesystem::remove(directory / "v");
  const Samples copy = samples;
  EXPECT_EQ(copy, Samples(std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'}));
  EXPECT_EQ(sample_bytes(copy).data(), sample_bytes(samples).data());
}

TEST(MappedSamples, FilesTooShortOrTooLongAreRefusedAsWhenRead) {
  const TemporaryFolder directory;
  for (const std::uint64_t mapped_from : {kAlways, kNever}) {
    for (const std::string text : {"abcdefg", "abcdefghi"}) {
      write_text(directory / "v", text);
      const std::string sentence = text.size() < 8 ? "the data end after 7 bytes" : "the data go on after the 8 bytes";
      expect_input_error([&] { read(directory / "v", kEight, mapped_from); }, {sentence});
    }
  }
}

TEST(MappedSamples, LargeVolumesAreMappedAndSmallOnesAreNot) {
  const TemporaryFolder directory;
  const auto large = directory / "v_512x512x256_uint8.raw";
  write_text(large, "");
  std::filesystem::resize_file(large, kMappedFileBytes);  // a hole: takes no room
  EXPECT_TRUE(is_mapped(read_volume(large).samples()));
  write_text(directory / "v_2x2x2_uint8.raw", "abcdefgh");
  EXPECT_FALSE(is_mapped(read_volume(directory / "v_2x2x2_uint8.raw").samples()));
}

TEST(MappedFile, HoldsTheBytesOfAFileOfTheExpectedSizeOnly) {
  const TemporaryFolder directory;
  write_text(directory / "v", "abc");
  const auto mapped = MappedFile::open(directory / "v", 3);
  ASSERT_NE(mapped, nullptr);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(mapped->bytes().data()), mapped->bytes().size()), "abc");
  EXPECT_EQ(MappedFile::open(directory / "v", 2), nullptr);
  EXPECT_EQ(MappedFile::open(directory / "v", 4), nullptr);
  EXPECT_EQ(MappedFile::open(directory / "none", 3), nullptr);
  write_text(directory / "empty", "");
  EXPECT_EQ(MappedFile::open(directory / "empty", 0), nullptr);
}

TEST(WriteVolume, PieceByPieceGivesTheSameFile) {
  const TemporaryFolder directory;
  const ScalarGrid whole = generate_field("noise", 9, 5);
  for (const std::int32_t slices : {1, 3, 9}) {
    for (const std::string name : {"a.nrrd", "a_9x9x9_uint8.raw"}) {
      FieldSlices field(find_analytic_field("noise"), 9, 5);
      write_volume(
          header_of(whole), [&] { return field.next(slices); }, directory / name, NrrdEncoding::kRaw);
      write_volume(whole, directory / ("whole_" + name), NrrdEncoding::kRaw);
      EXPECT_EQ(read_volume(directory / name).samples(), whole.samples());
      EXPECT_EQ(read_text(directory / name), read_text(directory / ("whole_" + name)));
    }
  }
}

TEST(WriteVolume, PiecesThatDoNotAddUpAreOurFault) {
  const TemporaryFolder directory;
  const VolumeHeader header{{2, 2, 2}, SampleType::kU8};
  const auto write = [&](const Samples& piece) {
    write_volume(
        header, [&] { return piece; }, directory / "v.nrrd");
  };
  EXPECT_THROW(write(std::vector<std::uint8_t>(3)), InternalError);
  EXPECT_THROW(write(std::vector<std::uint8_t>()), InternalError);
  EXPECT_THROW(write(std::vector<float>(8)), InternalError);
  EXPECT_EQ(directory.names().size(), 0u);
  write(std::vector<std::uint8_t>(4));
  EXPECT_EQ(directory.names().size(), 1u);
}

}  // namespace
}  // namespace deliso
