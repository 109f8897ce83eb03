// Files that are no volumes: each is refused with one sentence that names the file, the place, the value and the cure.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/volume_files.h"
#include "volume/io/nrrd.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

const std::string kSamples = "abcdefghijkl";  // 2 x 3 x 2 bytes

// Lines of a good header; each test breaks one.
struct Header {
  std::string magic = "NRRD0004\n";
  std::string type = "type: uint8\n";
  std::string dimension = "dimension: 3\n";
  std::string sizes = "sizes: 2 3 2\n";
  std::string encoding = "encoding: raw\n";
  std::string more;
  [[nodiscard]] std::string text() const { return magic + type + dimension + sizes + encoding + more + "\n"; }
};

class BadVolume : public testing::Test {
 protected:
  // Expects the file of these bytes to be refused, with the file's name and these parts in the message.
  void refuse(const std::string& content, std::initializer_list<std::string> parts,
              const std::string& name = "v.nrrd") {
    write_text(directory_ / name, content);
    expect_input_error([&] { read_volume(directory_ / name); }, parts, name);
  }
  void refuse(const Header& header, std::initializer_list<std::string> parts) {
    refuse(header.text() + kSamples, parts);
  }
  [[nodiscard]] std::string gzip_file(const ScalarGrid& grid) const {
    write_nrrd(grid, directory_ / "good.nrrd");
    return read_text(directory_ / "good.nrrd");
  }

  TemporaryDirectory directory_;
};

TEST_F(BadVolume, TheHeaderThatTheOthersBreakIsGood) {
  write_text(directory_ / "v.nrrd", Header().text() + kSamples);
  EXPECT_EQ(read_volume(directory_ / "v.nrrd").at(1, 2, 1), 'l');
}

TEST_F(BadVolume, FilesThatAreNotThereOrNoFiles) {
  expect_input_error([&] { read_volume(directory_ / "none.nrrd"); }, {"none.nrrd", "no such file"});
  std::filesystem::create_directory(directory_ / "dir.nrrd");
  expect_input_error([&] { read_volume(directory_ / "dir.nrrd"); }, {"dir.nrrd", "not a regular file"});
  ASSERT_EQ(::mkfifo((directory_ / "pipe.nrrd").c_str(), 0600), 0);
  expect_input_error([&] { read_volume(directory_ / "pipe.nrrd"); }, {"pipe.nrrd", "not a regular file"});
  expect_input_error([&] { read_volume(directory_ / "v.tiff"); }, {"v.tiff", "\".tiff\"", ".nrrd"});
  expect_input_error([&] { read_volume(directory_ / "v"); }, {"\"\"", ".nrrd"});
  write_text(directory_ / "file", "");
  expect_input_error([&] { read_volume(directory_ / "file/v.nrrd"); }, {"v.nrrd"});
}

TEST_F(BadVolume, FilesThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  write_text(directory_ / "v.nrrd", Header().text() + kSamples);
  std::filesystem::permissions(directory_ / "v.nrrd", std::filesystem::perms::none);
  expect_input_error([&] { read_volume(directory_ / "v.nrrd"); }, {"v.nrrd", "cannot be opened"});
}

TEST_F(BadVolume, EmptyFilesAndOtherKindsOfFile) {
  refuse("", {"empty"});
  refuse("\n", {"line 1", "NRRD0001"});
  refuse("NRRD", {"line 1", "\"NRRD\""});
  refuse("NRRD0009\n", {"line 1", "\"NRRD0009\"", "NRRD0005"});
  refuse("NRRD00045\n", {"line 1"});
  refuse(std::string("\x89PNG\r\n\x1a\n\0\1\2", 11), {"line 1", "expected NRRD"});
  refuse(std::string(3 << 20, 'x'), {"longer than 1 MiB"});
}

TEST_F(BadVolume, LinesThatAreNoHeaderLines) {
  Header header;
  header.more = "this is not a header line\n";
  refuse(header, {"line 6", "\"this is not a header line\"", "field: value"});
  header.more = "kinds:domain\n";
  refuse(header, {"line 6", "\"kinds:domain\""});
  header.more = std::string("\x01\x02\xff binary", 10) + "\n";
  refuse(header, {"line 6", "\"??? binary\""});
  header.more = "spacing: 1 1 1\n";
  refuse(header, {"line 6", "\"spacing\"", "\"spacings\""});
  header.more = "type: uint8\n";
  refuse(header, {"line 6", "\"type\"", "line 2"});
  header.more = ": 1\n";
  refuse(header, {"line 6"});
}

TEST_F(BadVolume, MissingFields) {
  for (const auto& [line, name] :
       {std::pair{&Header::type, "\"type\""}, std::pair{&Header::dimension, "\"dimension\""},
        std::pair{&Header::sizes, "\"sizes\""}, std::pair{&Header::encoding, "\"encoding\""}}) {
    Header header;
    header.*line = "";
    refuse(header, {"no field", name});
  }
  Header header;
  header.type = "type: int16\n";
  refuse(header, {"no field \"endian\"", "more than one byte"});
  refuse(Header().text(), {"no field \"data file\""}, "v.nhdr");
}

TEST_F(BadVolume, UnknownTypesEncodingsAndByteOrders) {
  for (const std::string type : {"uint32", "unsigned int", "int64", "block", "half", "", "uint8 uint8"}) {
    Header header;
    header.type = "type: " + type + "\n";
    refuse(header, {"line 2", "\"" + type + "\"", "uint8, int8, uint16, int16, int32, float or double"});
  }
  for (const std::string encoding : {"bzip2", "ascii", "hex", "RAW1"}) {
    Header header;
    header.encoding = "encoding: " + encoding + "\n";
    refuse(header, {"line 5", "\"" + encoding + "\"", "raw or gzip"});
  }
  Header header;
  header.more = "endian: middle\n";
  header.type = "type: short\n";
  refuse(header, {"line 6", "\"middle\"", "little or big"});
}

TEST_F(BadVolume, DimensionsThatMakeNoVolume) {
  for (const std::string dimension : {"2", "5", "0", "-3", "three", "3.0", ""}) {
    Header header;
    header.dimension = "dimension: " + dimension + "\n";
    refuse(header, {"line 3", "\"" + dimension + "\""});
  }
  for (const std::string sizes : {"2 3", "2 3 2 1", "2 3 0", "2 3 -2", "2 3 1", "2 3 2147483647", "2 3 x", "2 3 2.5",
                                  "2 3 99999999999999999999", ""}) {
    Header header;
    header.sizes = "sizes: " + sizes + "\n";
    refuse(header, {"line 4", "sizes"});
  }
  Header header;
  header.dimension = "dimension: 4\n";
  header.sizes = "sizes: 3 2 2 3\n";
  refuse(header, {"line 4", "\"3 2 2 3\"", "scalar"});
}

TEST_F(BadVolume, AHeaderThatLiesTakesNoMemory) {
  // Any of these would need from gigabytes to more than memory can address.
  for (const std::string sizes : {"100000 100000 100", "2000000 2000000 2000000", "2147483645 2147483645 2147483645"})
    for (const std::string encoding : {"raw", "gzip"}) {
      Header header;
      header.sizes = "sizes: " + sizes + "\n";
      header.encoding = "encoding: " + encoding + "\n";
      refuse(header, {"dimensions"});
    }
}

TEST_F(BadVolume, RawDataTooShortOrTooLong) {
  for (std::size_t length = 0; length < kSamples.size(); ++length)
    refuse(Header().text() + kSamples.substr(0, length), {"end after " + std::to_string(length) + " bytes", "12"});
  refuse(Header().text() + kSamples + "x", {"go on after", "12 bytes"});
  refuse(Header().text().substr(0, Header().text().size() - 1), {"ends within the header"});
}

TEST_F(BadVolume, GzipDataCutOffAnywhere) {
  const ScalarGrid grid({8, 8, 8}, random_samples<std::uint8_t>(512, 1));
  const std::string whole = gzip_file(grid);
  const std::size_t header = whole.find("\n\n") + 2;
  for (std::size_t length = header; length < whole.size(); ++length) refuse(whole.substr(0, length), {"v.nrrd: the"});
}

TEST_F(BadVolume, GzipDataWithAnyByteChangedAreNeverReadAsOther) {
  // The check sum of gzip guards every byte but a few of its header, which do not touch the samples.
  const ScalarGrid grid({6, 6, 6}, random_samples<std::uint8_t>(216, 2));
  const std::string whole = gzip_file(grid);
  int refused = 0;
  for (std::size_t n = whole.find("\n\n") + 2; n < whole.size(); ++n) {
    std::string bad = whole;
    bad[n] = static_cast<char>(bad[n] ^ 0x55);
    write_text(directory_ / "v.nrrd", bad);
    try {
      EXPECT_EQ(read_volume(directory_ / "v.nrrd").samples(), grid.samples()) << "byte " << n;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 216);
}

TEST_F(BadVolume, GzipDataTooLongOrFollowedByOtherBytes) {
  const std::string whole = gzip_file(ScalarGrid({2, 3, 2}, random_samples<std::uint8_t>(12, 1)));
  refuse(whole + "x", {"followed by bytes that are not gzip"});
  std::string fewer = whole;
  fewer.replace(fewer.find("sizes: 2 3 2"), 12, "sizes: 2 2 2");
  refuse(fewer, {"go on after", "8 bytes"});
  std::string more = whole;
  more.replace(more.find("sizes: 2 3 2"), 12, "sizes: 2 3 3");
  refuse(more, {"end after 12 bytes", "18"});
  Header header;
  header.encoding = "encoding: gzip\n";
  refuse(header, {"corrupt"});
}

TEST_F(BadVolume, GeometryThatIsNone) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"spacings: 1 1\n", "3 values"},
      {"spacings: 1 1 0\n", "positive spacing"},
      {"spacings: 1 1 -1\n", "positive spacing"},
      {"spacings: 1 1 inf\n", "finite number"},
      {"spacings: 1 1 1e999\n", "finite number"},
      {"spacings: 1 1 one\n", "\"one\""},
      {"axis mins: 0 0 0\naxis maxs: 1 1 -1\n", "positive spacing"},
      {"space directions: (1,0,0) (0,1,0)\n", "3 vectors"},
      {"space directions: (1,0,0) (0,1,0) none\n", "a direction for each axis"},
      {"space directions: (1,0,0) (0,1,0) (0,0)\n", "three numbers"},
      {"space directions: (1,0,0) (0,1,0) (0,0,x)\n", "\"x\""},
      {"space directions: (1,0,0) (0,1,0) (0,0,1\n", "(1,0,0)"},
      {"space directions: (1,0,0) (0,1,0) (0,0,0)\n", "along the axes"},
      {"space directions: (0,1,0) (1,0,0) (0,0,1)\n", "oblique and permuted"},
      {"space directions: (1,0.01,0) (0,1,0) (0,0,1)\n", "oblique and permuted"},
      {"space directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1\n", "not both"},
      {"space origin: (0,0)\n", "three numbers"},
      {"space origin: (0,0,nan)\n", "finite number"},
      {"space origin: 0 0 0\n", "(1,0,0)"},
  };
  for (const auto& [lines, part] : cases) {
    Header header;
    header.more = lines;
    refuse(header, {"line ", part});
  }
}

TEST_F(BadVolume, DataFilesAndSkipsThatLeadNowhere) {
  const auto with = [](const std::string& lines) {
    Header header;
    header.more = lines;
    return header.text();
  };
  refuse(with("data file: none.raw\n"), {"no such file"}, "v.nhdr");
  expect_input_error([&] { read_volume(directory_ / "v.nhdr"); }, {"none.raw"});
  refuse(with("data file: LIST\n"), {"line 6", "several files"}, "v.nhdr");
  refuse(with("data file: slice%03d.raw 1 9 1\n"), {"line 6", "several files"}, "v.nhdr");
  refuse(with("data file:\n"), {"line 6", "file name"}, "v.nhdr");
  refuse(with("line skip: -1\n") + kSamples, {"line 6", "\"-1\""});
  refuse(with("byte skip: -2\n") + kSamples, {"line 6", "\"-2\""});
  refuse(with("line skip: 5\n") + "one\ntwo\n", {"line skip", "5", "2 lines"});
  refuse(with("byte skip: 5\n") + "123", {"end after 3 bytes", "5 bytes"});
  refuse(with("byte skip: 9223372036854775807\n") + kSamples, {"end after 12 bytes"});
  refuse(with("byte skip: -1\n") + "123", {"end after 3 bytes"});
}

TEST_F(BadVolume, SamplesThatAreNotFinite) {
  std::vector<float> samples(12, 1.0f);
  samples[7] = std::numeric_limits<float>::quiet_NaN();
  const auto bytes = std::as_bytes(std::span(samples));
  Header header;
  header.type = "type: float\n";
  header.more = std::string("endian: ") + (std::endian::native == std::endian::little ? "little" : "big") + "\n";
  refuse(header.text() + std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
         {"sample (1, 0, 1)", "NaN"});
}

TEST_F(BadVolume, RawFilesWithoutDimensionsOrWithWrongOnes) {
  refuse(kSamples, {"needs dimensions and a type", "name_256x256x98_uint8.raw"}, "v.raw");
  refuse(kSamples, {"needs dimensions"}, "v_2x3_uint8.raw");
  refuse(kSamples, {"\"uint7\""}, "v_2x3x2_uint7.raw");
  refuse(kSamples, {"end after 12 bytes", "24"}, "v_2x3x2_uint16.raw");
  refuse(kSamples, {"go on after", "8 bytes"}, "v_2x2x2_uint8.raw");
  refuse(kSamples, {"0 x 3 x 2", "at least 2"}, "v_0x3x2_uint8.raw");
  refuse(kSamples, {"address"}, "v_99999999999999999999x99999999999x99999999999_uint8.raw");
  write_text(directory_ / "v.raw", kSamples);
  RawOptions options;
  options.dims = Dims{2, 3, 2};
  expect_input_error([&] { read_volume(directory_ / "v.raw", options); }, {"a type"});
  options.type = "int64";
  expect_input_error([&] { read_volume(directory_ / "v.raw", options); }, {"\"int64\"", "uint8"});
  options.type = "uint8";
  options.header_bytes = 13;
  expect_input_error([&] { read_volume(directory_ / "v.raw", options); }, {"13 bytes", "12"});
  options.header_bytes = 0;
  options.spacing = {1, 0, 1};
  expect_input_error([&] { read_volume(directory_ / "v.raw", options); }, {"v.raw", "spacing"});
}

TEST_F(BadVolume, ADiskThatIsFullLeavesNothingBehind) {
  // The process may write files of at most 1000 bytes: as if the disk were full.
  const ScalarGrid grid({20, 20, 20}, random_samples<std::uint8_t>(8000, 1));
  write_text(directory_ / "old.nrrd", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_input_error([&] { write_nrrd(grid, directory_ / "old.nrrd", NrrdEncoding::kRaw); }, {"old.nrrd", "writing"});
  expect_input_error([&] { write_nrrd(grid, directory_ / "new.nrrd", NrrdEncoding::kGzip); }, {"new.nrrd", "writing"});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(directory_.entries(), 1);
  EXPECT_EQ(read_text(directory_ / "old.nrrd"), "old");
}

}  // namespace
}  // namespace deliso
