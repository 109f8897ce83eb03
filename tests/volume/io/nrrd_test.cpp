// NRRD files: round trips over every type, byte order and encoding, and the header's many spellings.
#include "volume/io/nrrd/nrrd.h"

#include <gtest/gtest.h>

#include <zlib.h>

#include <algorithm>
#include <bit>

#include "tests/support/volume_files.h"
#include "volume/io/base/gzip_stream.h"
#include "volume/io/volume_file.h"
#include "volume/sample_type.h"

namespace deliso {
namespace {

// The samples' bytes in a byte order, written here without the code under test.
template <class Sample>
std::string bytes_of(const std::vector<Sample>& samples, bool big) {
  std::string out;
  for (const Sample s : samples) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Sample)>>(s);
    if (big == (std::endian::native == std::endian::little)) std::reverse(bytes.begin(), bytes.end());
    for (const char byte : bytes) out.push_back(byte);
  }
  return out;
}

// zlib's own one-shot compression, as gzip.
std::string gzip_of(const std::string& data) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&stream, data.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

const std::vector<std::uint8_t> kBytes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};  // 2 x 3 x 2
const std::string kRawBytes = bytes_of(kBytes, false);

// An attached raw file of 2 x 3 x 2 bytes with these lines in its header besides the necessary ones.
ScalarGrid read_with(const TemporaryFolder& directory, const std::string& lines) {
  const auto path = directory / "volume.nrrd";
  write_text(path, "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 3 2\nencoding: raw\n" + lines + "\n" + kRawBytes);
  return read_nrrd(path);
}

template <class Sample>
class NrrdOfType : public testing::Test {};
using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(NrrdOfType, SampleTypes);

TYPED_TEST(NrrdOfType, WrittenFilesReadBackBitForBit) {
  const TemporaryFolder directory;
  const ScalarGrid grid({5, 6, 7}, random_samples<TypeParam>(210, 1), {0.1, 1e-10, 3}, {-1.0 / 3, 1e-300, 0});
  for (const NrrdEncoding encoding : {NrrdEncoding::kRaw, NrrdEncoding::kGzip}) {
    write_nrrd(grid, directory / "a.nrrd", encoding);
    const ScalarGrid back = read_nrrd(directory / "a.nrrd");
    EXPECT_EQ(back.dims(), grid.dims());
    EXPECT_EQ(back.samples(), grid.samples());
    EXPECT_EQ(back.spacing(), grid.spacing());
    EXPECT_EQ(back.origin(), grid.origin());
  }
  EXPECT_EQ(directory.names().size(), 1u);
}

TYPED_TEST(NrrdOfType, BothByteOrdersAndEncodingsGiveTheSamples) {
  const TemporaryFolder directory;
  const auto samples = random_samples<TypeParam>(24, 2);
  const std::string type = nrrd_type_name(sample_type(Samples(samples)));
  for (const bool big : {false, true})
    for (const bool gzip : {false, true}) {
      const std::string data = bytes_of(samples, big);
      write_text(directory / "a.nrrd",
                 "NRRD0001\ntype: " + type + "\ndimension: 3\nsizes: 2 3 4\nendian: " + (big ? "big" : "little") +
                     "\nencoding: " + (gzip ? "gzip" : "raw") + "\n\n" + (gzip ? gzip_of(data) : data));
      EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), Samples(samples)) << big << gzip;
    }
}

TEST(Nrrd, DataOfManyChunksReadBack) {
  // 3.1 MiB of incompressible samples: several buffers of the reader, the writer and zlib.
  const TemporaryFolder directory;
  const ScalarGrid grid({131, 113, 111}, random_samples<std::int16_t>(std::size_t{131} * 113 * 111, 3));
  write_nrrd(grid, directory / "a.nrrd");
  EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), grid.samples());
}

TEST(Nrrd, EverySpellingOfATypeIsKnown) {
  const std::vector<std::pair<StoredType, std::vector<std::string>>> spellings{
      {StoredType::kU8, {"uchar", "unsigned char", "uint8", "uint8_t", "Unsigned  Char"}},
      {StoredType::kI8, {"signed char", "int8", "int8_t"}},
      {StoredType::kU16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {StoredType::kI16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {StoredType::kI32, {"int", "signed int", "int32", "int32_t"}},
      {StoredType::kU32, {"uint", "unsigned int", "uint32", "uint32_t", "u32"}},
      {StoredType::kI64, {"longlong", "long long", "long long int", "signed long long", "int64", "int64_t"}},
      {StoredType::kU64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
      {StoredType::kF16, {"half", "float16"}},
      {StoredType::kBool, {"bool"}},
      {StoredType::kF32, {"float"}},
      {StoredType::kF64, {"double"}}};
  for (const auto& [type, names] : spellings)
    for (const std::string& name : names) EXPECT_EQ(parse_stored_type(name), type) << name;
  for (const char* name : {"", "block", "char", "u 8", "uint128", "complex"})
    EXPECT_FALSE(parse_stored_type(name).has_value()) << name;
}

TEST(Nrrd, CommentsKeysAndDescriptiveFieldsAreTolerated) {
  const TemporaryFolder directory;
  const ScalarGrid grid = read_with(directory,
                                    "# a comment: with a colon\n"
                                    "key:=value: with a colon\n"
                                    "another key with spaces:=\n"
                                    "content: something\n"
                                    "old min: 0\noldmax: 255\n"
                                    "kinds: domain domain domain\n"
                                    "labels: \"x\" \"y\" \"z\"\n"
                                    "units: \"mm\" \"mm\" \"mm\"\n"
                                    "space: left-posterior-superior\n"
                                    "thicknesses: NaN NaN NaN\n"
                                    "sample units: \"HU\"\n");
  EXPECT_EQ(grid.samples(), Samples(kBytes));
  EXPECT_EQ(grid.spacing(), (Vec3{1, 1, 1}));
  EXPECT_EQ(grid.origin(), (Vec3{0, 0, 0}));
}

TEST(Nrrd, UnitsAreThoseOfTheSpaceOrElseOfTheVolumesAxes) {
  const TemporaryFolder directory;
  const auto units_with = [&](const std::string& lines) {
    static_cast<void>(read_with(directory, lines));
    return read_placed_volume(directory / "volume.nrrd").placement.units;
  };
  EXPECT_EQ(units_with(""), "");
  EXPECT_EQ(units_with("units: \"mm\" \"mm\" \"mm\"\n"), "mm");
  EXPECT_EQ(units_with("units: \"um\" \"um\" \"\"\n"), "um");
  EXPECT_EQ(units_with("units: \"mm\" \"mm\" \"s\"\n"), "mm, s");
  EXPECT_EQ(units_with("units: mm mm mm\n"), "");  // the format wants quotes
  const std::string space = "space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n";
  EXPECT_EQ(units_with(space + "space units: \"mm\" \"mm\" \"mm\"\nunits: \"s\" \"s\" \"s\"\n"), "mm");
  const std::string of_colors =
      "NRRD0005\ntype: uchar\ndimension: 4\nsizes: 1 2 3 2\nencoding: raw\nkinds: RGB-color domain domain domain\n"
      "units: \"\" \"cm\" \"cm\" \"cm\"\n\n";
  write_text(directory / "colors.nrrd", of_colors + kRawBytes);
  EXPECT_EQ(read_placed_volume(directory / "colors.nrrd").placement.units, "cm");
}

TEST(Nrrd, LineEndsOfWindowsAndFieldsInCapitalsAreTolerated) {
  const TemporaryFolder directory;
  write_text(directory / "a.nrrd",
             "NRRD0004\r\nType: uchar\r\nDimension: 3\r\nSizes:  2 3\t2 \r\nEncoding: raw\r\n\r\n" + kRawBytes);
  EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), Samples(kBytes));
}

TEST(Nrrd, GeometryFromSpacingsAndAxisLimits) {
  const TemporaryFolder directory;
  const ScalarGrid a = read_with(directory, "spacings: 0.5 +1.5 2e1\naxis mins: -1 0 NaN\n");
  EXPECT_EQ(a.spacing(), (Vec3{0.5, 1.5, 20}));
  EXPECT_EQ(a.origin(), (Vec3{-1, 0, 0}));
  // Without spacings the limits tell them: between the outer nodes, or between the outer cells' sides.
  const ScalarGrid b = read_with(directory, "axis mins: 0 0 0\naxis maxs: 1 4 6\ncenters: node node cell\n");
  EXPECT_EQ(b.spacing(), (Vec3{1, 2, 3}));
  EXPECT_EQ(b.origin(), (Vec3{0, 0, 1.5}));
  // All three may be there where they agree up to rounding: as nodes or, unless that is said, as cells.
  for (const std::string maxs :
       {"0.3333 1.3333 2.3333", "0.6667 2 4.6667", "0.6667 2 4.6667\ncenters: cell cell none"}) {
    SCOPED_TRACE(maxs);
    const ScalarGrid both =
        read_with(directory, "spacings: 0.333333 0.666667 2.33333\naxis mins: 0 0 0\naxis maxs: " + maxs + "\n");
    EXPECT_EQ(both.spacing(), (Vec3{0.333333, 0.666667, 2.33333}));
  }
  const ScalarGrid c = read_with(directory, "spacings: NaN 2 3\n");
  EXPECT_EQ(c.spacing(), (Vec3{1, 2, 3}));
}

TEST(Nrrd, GeometryFromSpaceDirections) {
  const TemporaryFolder directory;
  const ScalarGrid grid = read_with(directory,
                                    "space dimension: 3\nspace directions: (0.5,0,0) (0, 1.5, 0) (0,0,2)\n"
                                    "space origin: (-1,2,3.25)\n");
  EXPECT_EQ(grid.spacing(), (Vec3{0.5, 1.5, 2}));
  EXPECT_EQ(grid.origin(), (Vec3{-1, 2, 3.25}));
  EXPECT_EQ(grid.samples(), Samples(kBytes));
}

TEST(Nrrd, AxesThatRunBackwardsKeepTheirWorldPositions) {
  // Sample (i, j, k) of the file lies at origin + i d0 + j d1 + k d2, whatever the signs: check every one.
  const TemporaryFolder directory;
  for (int signs = 0; signs < 8; ++signs) {
    const Vec3 step{(signs & 1) != 0 ? -0.5 : 0.5, (signs & 2) != 0 ? -1.0 : 1.0, (signs & 4) != 0 ? -2.0 : 2.0};
    const ScalarGrid grid =
        read_with(directory, std::string("space dimension: 3\nspace origin: (10,20,30)\n") + "space directions: (" +
                                 std::to_string(step.x) + ",0,0) (0," + std::to_string(step.y) + ",0) (0,0," +
                                 std::to_string(step.z) + ")\n");
    EXPECT_EQ(grid.spacing(), (Vec3{0.5, 1, 2}));
    for (int n = 0; n < 12; ++n) {
      const int row = n / 2;
      const int slice = n / 6;
      const Vec3 place_in_file{double(n % 2), double(row % 3), double(slice)};
      const Vec3 world = Vec3{10, 20, 30} + scaled(step, place_in_file);
      const Vec3 place = world - grid.origin();
      EXPECT_EQ(grid.at(static_cast<int>(place.x / 0.5), static_cast<int>(place.y), static_cast<int>(place.z / 2)), n)
          << "signs " << signs;
    }
  }
}

TEST(Nrrd, AnAxisOfOneSampleMayComeFirstOrLast) {
  const TemporaryFolder directory;
  for (const std::string& lines :
       {std::string("sizes: 1 2 3 2\nspacings: NaN 1 2 3\n"), std::string("sizes: 2 3 2 1\nspacings: 1 2 3 NaN\n"),
        std::string("sizes: 1 2 3 2\nspace directions: none (1,0,0) (0,2,0) (0,0,3)\nspace dimension: 3\n")}) {
    write_text(directory / "a.nrrd", std::string("NRRD0005\ntype: uint8\ndimension: 4\nencoding: raw\n")
                                         .append(lines)
                                         .append("\n")
                                         .append(kRawBytes));
    const ScalarGrid grid = read_nrrd(directory / "a.nrrd");
    EXPECT_EQ(grid.dims(), (Dims{2, 3, 2}));
    EXPECT_EQ(grid.spacing(), (Vec3{1, 2, 3}));
    EXPECT_EQ(grid.samples(), Samples(kBytes));
  }
}

TEST(Nrrd, DetachedHeadersFindTheirDataBesideThem) {
  const TemporaryFolder directory;
  std::filesystem::create_directory(directory / "sub");
  const std::string head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 2\n";
  write_text(directory / "sub/v.raw", kRawBytes);
  write_text(directory / "sub/v.raw.gz", gzip_of(kRawBytes));
  const auto read = [&](const std::string& lines) {
    write_text(directory / "v.nhdr", head + lines);
    return read_nrrd(directory / "v.nhdr").samples();
  };
  EXPECT_EQ(read("encoding: raw\ndata file: sub/v.raw\n"), Samples(kBytes));
  EXPECT_EQ(read("encoding: gz\ndatafile: ./sub/v.raw.gz"), Samples(kBytes));
  EXPECT_EQ(read(std::string("encoding: raw\ndata file: ") + (directory / "sub/v.raw").c_str() + "\n\n"),
            Samples(kBytes));
}

TEST(Nrrd, LinesAndBytesBeforeTheDataAreSkipped) {
  const TemporaryFolder directory;
  const std::string head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 2\ndata file: v.dat\n";
  const auto read = [&](const std::string& lines, const std::string& data) {
    write_text(directory / "v.dat", data);
    write_text(directory / "v.nhdr", head + lines);
    return read_nrrd(directory / "v.nhdr").samples();
  };
  EXPECT_EQ(read("encoding: raw\nline skip: 2\n", "one\ntwo\r\n" + kRawBytes), Samples(kBytes));
  EXPECT_EQ(read("encoding: raw\nbyte skip: 5\n", "\n\n234" + kRawBytes), Samples(kBytes));
  EXPECT_EQ(read("encoding: raw\nline skip: 1\nbyte skip: 3\n", "one\n\n\n\n" + kRawBytes), Samples(kBytes));
  EXPECT_EQ(read("encoding: raw\nbyte skip: -1\n", "anything of any length" + kRawBytes), Samples(kBytes));
  // Lines are skipped before, bytes after decompression.
  EXPECT_EQ(read("encoding: gzip\nline skip: 1\nbyte skip: 3\n", "one\n" + gzip_of("abc" + kRawBytes)),
            Samples(kBytes));
}

TEST(Nrrd, GzipDataOfSeveralMembersAreOneStream) {
  const TemporaryFolder directory;
  write_text(directory / "a.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 2\nencoding: gzip\n\n" +
                                       gzip_of(kRawBytes.substr(0, 5)) + gzip_of("") + gzip_of(kRawBytes.substr(5)));
  EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), Samples(kBytes));
}

TEST(Nrrd, HighlyCompressibleDataAreNotTakenForALie) {
  // Zeros compress by nearly deflate's limit of 1032 to 1.
  const TemporaryFolder directory;
  const ScalarGrid grid({200, 200, 200}, std::vector<std::uint8_t>(8000000));
  write_nrrd(grid, directory / "a.nrrd");
  EXPECT_LT(std::filesystem::file_size(directory / "a.nrrd"), 9000u);
  EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), grid.samples());
}

TEST(Nrrd, WritingReplacesAFileOnlyWhenItSucceeds) {
  const TemporaryFolder directory;
  const ScalarGrid grid({2, 3, 2}, kBytes);
  write_text(directory / "a.nrrd", "old");
  write_nrrd(grid, directory / "a.nrrd");
  EXPECT_EQ(read_nrrd(directory / "a.nrrd").samples(), grid.samples());
  // A directory in the way, a missing directory: nothing is written and nothing stays.
  std::filesystem::create_directory(directory / "b.nrrd");
  expect_input_error([&] { write_nrrd(grid, directory / "b.nrrd"); }, {"b.nrrd", "not a regular file"});
  expect_input_error([&] { write_nrrd(grid, directory / "none/c.nrrd"); }, {"c.nrrd", "cannot be made"});
  EXPECT_EQ(directory.names().size(), 2u);
}

}  // namespace
}  // namespace deliso
