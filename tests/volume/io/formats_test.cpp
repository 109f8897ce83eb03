// What no other tool at hand writes: types that are converted, channels, data in several files, INR, PVM, raw names;
// and sentences for files that are read by others.
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "tests/support/volume_files.h"
#include "volume/io/base/sample_conversion.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

template <class Number>
std::string memory_of(const std::vector<Number>& numbers) {
  const auto bytes = std::as_bytes(std::span(numbers));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string packed(const std::string& data) {
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

const std::string kHost = std::endian::native == std::endian::little ? "little" : "big";
const std::string kTwelve = "abcdefghijkl";
const Samples kTwelveSamples = std::vector<std::uint8_t>(kTwelve.begin(), kTwelve.end());

// An NRRD file of 2 x 3 x 2 samples with these lines.
std::string nrrd(const std::string& type, const std::string& lines, const std::string& data) {
  return "NRRD0005\ntype: " + type + "\ndimension: 3\nsizes: 2 3 2\nendian: " + kHost + "\n" + lines + "\n" + data;
}

class Formats : public testing::Test {
 protected:
  Volume read(const std::string& name, const std::string& content, const ReadOptions& options = {}) {
    write_text(directory_ / name, content);
    return read_placed_volume(directory_ / name, options);
  }
  void refuse(const std::string& name, const std::string& content, std::initializer_list<std::string> parts,
              const ReadOptions& options = {}) {
    write_text(directory_ / name, content);
    expect_input_error([&] { read_placed_volume(directory_ / name, options); }, parts, name);
  }
  TemporaryFolder directory_;
};

ReadOptions channel(std::uint64_t n) {
  ReadOptions options;
  options.channel = n;
  return options;
}

TEST(HalfFloats, AreFloatsExactly) {
  EXPECT_EQ(float_of_half(0x3C00), 1.0f);
  EXPECT_EQ(float_of_half(0xC000), -2.0f);
  EXPECT_EQ(float_of_half(0x7BFF), 65504.0f);
  EXPECT_EQ(float_of_half(0x0001), std::ldexp(1.0f, -24));
  EXPECT_EQ(float_of_half(0x8400), -std::ldexp(1.0f, -14));
  EXPECT_EQ(float_of_half(0xFC00), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(float_of_half(0x7E00)));
}

TEST_F(Formats, WholeNumbersOfManyBitsAreKeptExactlyOrRefused) {
  std::vector<std::uint32_t> small(12, 7);
  EXPECT_EQ(read("a.nrrd", nrrd("uint32", "encoding: raw\n", memory_of(small))).grid.samples(),
            Samples(std::vector<std::int32_t>(12, 7)));
  small[5] = 4000000000u;
  std::vector<double> wide(12, 7);
  wide[5] = 4e9;
  EXPECT_EQ(read("a.nrrd", nrrd("uint", "encoding: raw\n", memory_of(small))).grid.samples(), Samples(wide));
  std::vector<std::uint64_t> large(12, 1);
  large[9] = std::uint64_t{1} << 63;
  wide.assign(12, 1);
  wide[9] = 0x1p63;
  EXPECT_EQ(read("a.nrrd", nrrd("uint64", "encoding: raw\n", memory_of(large))).grid.samples(), Samples(wide));
  large[7] = (std::uint64_t{1} << 53) + 1;
  refuse("a.nrrd", nrrd("uint64", "encoding: raw\n", memory_of(large)),
         {"sample (1, 0, 1)", "9007199254740993", "no double"});
  large[7] = std::numeric_limits<std::uint64_t>::max();
  refuse("a.nrrd", nrrd("uint64", "encoding: raw\n", memory_of(large)), {"sample (1, 0, 1)", "18446744073709551615"});
  std::vector<std::int64_t> negative(12, -1);
  negative[0] = std::numeric_limits<std::int64_t>::min();
  wide.assign(12, -1);
  wide[0] = -0x1p63;
  EXPECT_EQ(read("a.nrrd", nrrd("int64", "encoding: raw\n", memory_of(negative))).grid.samples(), Samples(wide));
  negative[3] = std::numeric_limits<std::int64_t>::max();
  refuse("a.nrrd", nrrd("int64", "encoding: raw\n", memory_of(negative)), {"sample (1, 1, 0)", "9223372036854775807"});
}

TEST_F(Formats, NrrdEncodingsInAnyCaseAndTextWithItsMarks) {
  const Samples expected = std::vector<std::int16_t>{0, -1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -300};
  const std::string numbers = "0 -1 2,3\n4 5 6 7 8 9\r\n10 -300\n";
  for (const char* const name : {"text", "TXT", "ascii", "Ascii"})
    EXPECT_EQ(read("a.nrrd", nrrd("short", std::string("encoding: ") + name + "\n", numbers)).grid.samples(), expected);
  EXPECT_EQ(read("a.nrrd", "\xEF\xBB\xBF" + nrrd("short", "encoding: TEXT\n", numbers)).grid.samples(), expected);
  EXPECT_EQ(read("a.nrrd", nrrd("uchar", "encoding: HEX\n", "616263646566\n6768696A6b6c\n")).grid.samples(),
            kTwelveSamples);
  EXPECT_EQ(read("a.nrrd", nrrd("uchar", "encoding: RAW\n", kTwelve)).grid.samples(), kTwelveSamples);
  EXPECT_EQ(read("a.nrrd", nrrd("uchar", "encoding: GZip\n", packed(kTwelve))).grid.samples(), kTwelveSamples);
  // The whole file packed, whatever its name, also around packed data.
  EXPECT_EQ(read("a.nrrd", packed(nrrd("uchar", "encoding: gzip\n", packed(kTwelve)))).grid.samples(), kTwelveSamples);
  refuse("a.nrrd", nrrd("uchar", "encoding: text\n", "1 2 3 4 5 6 7 8 9 10 11 256"), {"number 11", "\"256\"", "u8"});
  refuse("a.nrrd", nrrd("uchar", "encoding: text\n", "1 2 3" + std::string(40, ' ')), {"ends after 3 numbers", "12"});
  refuse("a.nrrd", nrrd("uchar", "encoding: hex\n", "61626"), {"5 hexadecimal digits, an odd number", "expected 24"});
  refuse("a.nrrd", nrrd("uchar", "encoding: hex\n", "6x"), {"\"x\""});
}

TEST_F(Formats, NrrdDataMayEndTheFileOrLieInSeveral) {
  EXPECT_EQ(
      read("a.nrrd", nrrd("uchar", "encoding: gzip\nbyte skip: -1\n", packed("anything" + kTwelve))).grid.samples(),
      kTwelveSamples);
  for (int n = 0; n < 4; ++n) {
    const std::string part = kTwelve.substr(3 * static_cast<std::size_t>(n), 3);
    write_text(directory_ / ("p0" + std::to_string(n) + ".raw"), "head" + part);
    write_text(directory_ / ("p0" + std::to_string(n) + ".gz"), packed(part));
  }
  EXPECT_EQ(
      read("a.nhdr", nrrd("uchar", "encoding: raw\nbyte skip: 4\ndata file: p%02d.raw 0 3 1 2\n", "")).grid.samples(),
      kTwelveSamples);
  EXPECT_EQ(
      read("a.nhdr", nrrd("uchar", "encoding: raw\nbyte skip: -1\ndata file: p%02d.raw 0 3 1\n", "")).grid.samples(),
      kTwelveSamples);
  const std::string list = "encoding: gzip\ndata file: LIST 2\np00.gz\np01.gz\np02.gz\np03.gz\n";
  EXPECT_EQ(read("a.nhdr", nrrd("uchar", list, "")).grid.samples(), kTwelveSamples);
  const std::string backwards = "encoding: raw\nbyte skip: 4\ndata file: p%02d.raw 3 0 -1\n";
  EXPECT_EQ(read("a.nhdr", nrrd("uchar", backwards, "")).grid.at(0, 0, 0), 'j');
  write_text(directory_ / "p02.raw", "head");
  write_text(directory_ / "a.nhdr", nrrd("uchar", "encoding: raw\nbyte skip: 4\ndata file: p%02d.raw 0 3 1\n", ""));
  expect_input_error([&] { read_placed_volume(directory_ / "a.nhdr"); }, {"p02.raw", "after 0 bytes", "share is 3"});
}

TEST_F(Formats, ChannelsAreChosenOrNamed) {
  const std::string head = "NRRD0005\ntype: uchar\ndimension: 4\nencoding: raw\n";
  // Pairs of values, and a row of two volumes.
  const std::string pairs = head + "sizes: 2 2 3 2\nkinds: vector domain domain domain\n\n";
  std::string data;
  for (const char c : kTwelve) data += {'?', c};
  EXPECT_EQ(read("a.nrrd", pairs + data, channel(1)).grid.samples(), kTwelveSamples);
  refuse("a.nrrd", pairs + data, {"2 values a voxel", "channels 0 to 1", "--channel N"});
  refuse("a.nrrd", pairs + data, {"no channel 2", "channels 0 to 1"}, channel(2));
  const std::string row = head + "sizes: 2 3 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n\n";
  EXPECT_EQ(read("a.nrrd", row + "mnopqrstuvwx" + kTwelve, channel(1)).grid.samples(), kTwelveSamples);
  EXPECT_EQ(read("a.nrrd", row + kTwelve + "mnopqrstuvwx", channel(0)).grid.samples(), kTwelveSamples);
  refuse("a.nrrd", row + kTwelve, {"end after 12 bytes", "24"}, channel(0));
  refuse("a.nrrd", nrrd("uchar", "encoding: raw\n", kTwelve), {"no channel 1", "one value a voxel"}, channel(1));
  refuse("a.nrrd", head + "sizes: 2 3 2 2\nkinds: domain vector domain domain\n\n" + data, {"axes of space"});
}

TEST_F(Formats, InrHasItsGeometryAndScale) {
  std::string header =
      "#INRIMAGE-4#{\nXDIM=2\nYDIM=3\nZDIM=2\nVDIM=1\nTYPE=unsigned fixed\nSCALE=2**0\n"
      "PIXSIZE=8 bits\nCPU=decm\nVX=0.5\nVY=1\nVZ=2.5\nTX=-1\nTY=2\nTZ=3\n";
  const auto file = [](std::string text, const std::string& data) {
    text.resize(256 - 4, '\n');
    return text + "##}\n" + data;
  };
  const Volume volume = read("a.inr", file(header, kTwelve));
  EXPECT_EQ(volume.grid.samples(), kTwelveSamples);
  EXPECT_EQ(volume.grid.spacing(), (Vec3{0.5, 1, 2.5}));
  EXPECT_EQ(volume.grid.origin(), (Vec3{-1, 2, 3}));
  EXPECT_EQ(read("b.inr.gz", packed(file(header, kTwelve))).grid.samples(), kTwelveSamples);
  header.replace(header.find("2**0"), 4, "2**3");
  EXPECT_EQ(read("a.inr", file(header, kTwelve)).grid.at(0, 0, 0), 8 * 'a');
  refuse("a.inr", file(header, "abc"), {"end after 3 bytes", "12"});
  refuse("a.inr", file(header + "RZ=0.5\n", kTwelve), {"RZ", "0.5"});
  header.replace(header.find("8 bits"), 6, "9 bits");
  refuse("a.inr", file(header, kTwelve), {"PIXSIZE", "9 bits"});
  refuse("a.inr", "#INRIMAGE-4#{\nXDIM=2\n", {"does not end"});
}

// A differential data stream as its format says, written bit by bit: every run has one number of nine bits or fewer.
std::string dds_of(const std::string& data, std::size_t per_sample, std::size_t row) {
  std::string apart;
  for (std::size_t byte = 0; byte < per_sample; ++byte)
    for (std::size_t n = byte; n < data.size(); n += per_sample) apart += data[n];
  std::vector<bool> bits;
  const auto put = [&](unsigned value, unsigned width) {
    for (unsigned n = width; n-- > 0;) bits.push_back((value >> n & 1u) != 0);
  };
  put(static_cast<unsigned>(per_sample - 1), 2);
  put(static_cast<unsigned>(row - 1), 16);
  const auto at = [&](std::size_t n) { return static_cast<int>(static_cast<unsigned char>(apart[n])); };
  for (std::size_t n = 0; n < apart.size(); ++n) {
    int difference = at(n) - (n > 0 ? at(n - 1) : 0);
    if (row > 1 && n > row) difference -= at(n - row) - at(n - row - 1);
    difference = ((difference % 256) + 256 + 128) % 256 - 128;  // from -128 to 127: eight bits
    put(1, 7);
    put(7, 3);
    put(static_cast<unsigned>(difference + 128), 8);
  }
  put(0, 7);
  std::string out((bits.size() + 7) / 8, '\0');
  for (std::size_t n = 0; n < bits.size(); ++n) {
    if (bits[n]) out[n / 8] = static_cast<char>(static_cast<unsigned char>(out[n / 8]) | 0x80u >> n % 8);
  }
  return out;
}

TEST_F(Formats, PvmIsReadPlainAndPacked) {
  EXPECT_EQ(read("a.pvm", "PVM\n2 3 2\n1\n" + kTwelve).grid.samples(), kTwelveSamples);
  const std::string spaced = "PVM3\n2 3 2\n0.5 1 2\n1\n" + kTwelve + std::string("text\0\0\0\0", 8);
  EXPECT_EQ(read("a.pvm", spaced).grid.spacing(), (Vec3{0.5, 1, 2}));
  const Samples words = std::vector<std::uint16_t>{0x6162, 0x6364, 0x6566, 0x6768, 0x696a, 0x6b6c, 1, 2, 3, 4, 5, 6};
  const std::string two = "PVM2\n2 3 2\n1 1 1\n2\n" + kTwelve + std::string("\0\1\0\2\0\3\0\4\0\5\0\6", 12);
  EXPECT_EQ(read("a.pvm", two).grid.samples(), words);
  for (const std::size_t row : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    EXPECT_EQ(read("a.pvm", "DDS v3d\n" + dds_of(spaced, 1, row)).grid.samples(), kTwelveSamples) << row;
    EXPECT_EQ(read("a.pvm", "DDS v3e\n" + dds_of(two, 2, row)).grid.samples(), words) << row;
  }
  refuse("a.pvm", ("DDS v3d\n" + dds_of(spaced, 1, 2)).substr(0, 30), {"end early"});
  refuse("a.pvm", "PVM\n2 3\n1\n" + kTwelve, {"\"2 3\"", "three dimensions"});
  refuse("a.pvm", "PVM\n2 3 2\n1\nabc", {"end after 3 bytes", "12"});
  refuse("a.pvm", "PVM9\n", {"\"PVM9\""});
}

TEST_F(Formats, RawFilesArePackedByTheirContentAlone) {
  EXPECT_EQ(read("v_2x3x2_uint8.raw", packed(kTwelve)).grid.samples(), kTwelveSamples);
  EXPECT_EQ(read("v_2x3x2_uint8.raw.gz", packed(kTwelve)).grid.samples(), kTwelveSamples);
  EXPECT_EQ(read("v-uint8-2x3x2.raw", kTwelve).grid.samples(), kTwelveSamples);
  // Samples that look like gzip are samples.
  const std::string lookalike = "\x1f\x8b\x08" + kTwelve.substr(3);
  EXPECT_EQ(read("v_2x3x2_uint8.raw", lookalike).grid.at(1, 0, 0), 0x8b);
  RawOptions skip;
  skip.header_bytes = 4;
  EXPECT_EQ(read("v_2x3x2_uint8.raw", "head" + kTwelve, skip).grid.samples(), kTwelveSamples);
  EXPECT_EQ(read("v_2x3x2_uint8.raw", packed("head" + kTwelve), skip).grid.samples(), kTwelveSamples);
}

TEST_F(Formats, DirectionsOfAnyKindPlaceTheSamples) {
  const auto placed = [&](const std::string& directions) {
    return read(
        "a.nrrd",
        nrrd("uchar", "encoding: raw\nspace: LPS\nspace origin: (10,20,30)\nspace directions: " + directions + "\n",
             kTwelve));
  };
  // Axes permuted and reversed: sample (1, 2, 1) is where the header puts it.
  const Volume turned = placed("(0,2,0) (0,0,-3) (-0.5,0,0)");
  EXPECT_EQ(turned.grid.samples(), kTwelveSamples);
  EXPECT_EQ(turned.grid.spacing(), (Vec3{2, 3, 0.5}));
  EXPECT_EQ(turned.placement.to_world({2, 6, 0.5}), (Vec3{9.5, 22, 24}));
  EXPECT_FALSE(turned.placement.reflects());
  EXPECT_FALSE(turned.placement.is_sheared());
  EXPECT_TRUE(placed("(0,2,0) (0,0,-3) (0.5,0,0)").placement.reflects());
  EXPECT_TRUE(placed("(1,0,0) (0.5,1,0) (0,0,1)").placement.is_sheared());
  EXPECT_FALSE(placed("(0.48828125,-1.2e-17,0) (1.1e-17,0.48828125,0) (0,0,2.5)").placement.is_sheared());
  EXPECT_TRUE(placed("(1,0,0) (0,1,0) (0,0,1)").placement.is_identity());
  EXPECT_TRUE(placed("(-1,0,0) (0,1,0) (0,0,1)").placement.is_identity());
  EXPECT_EQ(in_space(turned.placement, "RAS").to_world({2, 6, 0.5}), (Vec3{-9.5, -22, 24}));
  expect_input_error([&] { in_space(turned.placement, "MNI"); }, {"native, LPS or RAS", "MNI"});
  expect_input_error([&] { in_space(Placement(), "RAS"); }, {"does not say its space"});
}

TEST_F(Formats, NumpyHeadersThatAreNone) {
  const auto npy = [](const std::string& dictionary) {
    return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(dictionary.size()) + '\0' + dictionary + kTwelve;
  };
  EXPECT_EQ(read("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 2), }")).grid.samples(),
            kTwelveSamples);
  refuse("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': , }"), {"'shape'", "tuple"});
  refuse("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 6), }"),
         {"'shape' is \"(2, 6)\"", "three axes"});
  refuse("a.npy", npy("{'descr': '|O', 'fortran_order': False, 'shape': (2, 3, 2), }"), {"'descr'", "\"'|O'\""});
  refuse("a.npy", npy("{'descr': '|u1', 'shape': (2, 3, 2), }"), {"'fortran_order'"});
  refuse("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 99), }"), {"12 bytes", "594"});
  refuse("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 0, 2), }"), {"'shape' along y is 0"});
}

TEST_F(Formats, OthersAreNamedWithAProgramThatConvertsThem) {
  refuse("scan.dcm", std::string(128, '\0') + "DICM", {"dcm2niix"});
  std::filesystem::create_directory(directory_ / "series");
  expect_input_error([&] { read_volume(directory_ / "series"); }, {"series", "dcm2niix"});
  refuse("stack.tif", "II*", {"3D Slicer", ".tif"});
  refuse("v.xyz", "", {"\".xyz\"", ".nrrd"});
}

}  // namespace
}  // namespace deliso
