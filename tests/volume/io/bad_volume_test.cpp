// Files that are no volumes: each is refused with one sentence that names the file, the place, the value and the cure.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "tests/support/bad_volumes.h"
#include "tests/support/volume_files.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

using test::BadVolume;
using test::Header;
using test::kSamples;

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
  // What is missing is called missing, whatever its name; what is there and no volume by its name.
  for (const char* name : {"v.tiff", "v"}) {
    expect_input_error([&] { read_volume(directory_ / name); }, {name, "no such file"});
    write_text(directory_ / name, "no volume");
  }
  expect_input_error([&] { read_volume(directory_ / "v.tiff"); }, {"v.tiff", "\".tiff\"", ".nrrd"});
  expect_input_error([&] { read_volume(directory_ / "v"); }, {"v: has no extension", ".nrrd"});
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
  options.type = "int65";
  expect_input_error([&] { read_volume(directory_ / "v.raw", options); }, {"\"int65\"", "uint8"});
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
  EXPECT_EQ(directory_.names().size(), 1u);
  EXPECT_EQ(read_text(directory_ / "old.nrrd"), "old");
}

}  // namespace
}  // namespace deliso
