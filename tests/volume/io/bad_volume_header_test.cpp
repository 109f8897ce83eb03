// Headers that describe no volume: lines, fields, types, dimensions and geometry that are refused.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/bad_volumes.h"
#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

using test::BadVolume;
using test::Header;
using test::kSamples;

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
  for (const std::string type : {"uint128", "block", "char", "complex", "", "uint8 uint8"}) {
    Header header;
    header.type = "type: " + type + "\n";
    refuse(header, {"line 2", "\"" + type + "\"", "uint8, int8, uint16, int16, uint32, int32"});
  }
  for (const std::string encoding : {"bzip2", "zrl", "RAW1"}) {
    Header header;
    header.encoding = "encoding: " + encoding + "\n";
    refuse(header, {"line 5", "\"" + encoding + "\"", "raw, gzip, text or hex"});
  }
  Header header;
  header.more = "endian: middle\n";
  header.type = "type: short\n";
  refuse(header, {"line 6", "\"middle\"", "little or big"});
}

TEST_F(BadVolume, DimensionsThatMakeNoVolume) {
  for (const std::string dimension : {"2", "17", "0", "-3", "three", "3.0", ""}) {
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
  refuse(header, {"3 volumes", "channels 0 to 2", "--channel"});
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
      {"space directions: (1,0,0) (0,1,0) (0,0,0)\n", "length"},
      {"space directions: (0,1,0) (1,0,0) (1,1,0)\n", "in a plane"},
      {"space directions: (1,0,0) (2,0,0) (0,0,1)\n", "in a plane"},
      {"space directions: (1,1,0) (1,-1,0) (0,0,1e200)\n", "length"},
      {"space directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1\n", "not both"},
      {"space origin: (0,0)\n", "three numbers"},
      {"space origin: (0,0,nan)\n", "finite number"},
      {"space origin: 0 0 0\n", "(1,0,0)"},
      {"space dimension: 7\n", "expected 3"},
      {"space dimension: three\n", "whole number"},
      {"centers: foo bar baz\n", "cell, node, none or ???"},
      {"centers: node node\n", "3 values, not 2"},
      {"kinds: domain domain\n", "3 values, not 2"},
      {"spacings: 1 1 1\naxis mins: 0 0 0\naxis maxs: 1 2 9\n", "\"axis maxs\" is \"1 2 9\""},
  };
  for (const auto& [lines, part] : cases) {
    Header header;
    header.more = lines;
    refuse(header, {"line ", part});
  }
}

// The header is to blame, not the file of the samples.
TEST_F(BadVolume, MetaImagesWithoutASenseOrWithTwo) {
  const std::string head = "NDims = 3\nElementType = MET_UCHAR\n", tail = "ElementDataFile = d.raw\n";
  write_text(directory_ / "d.raw", kSamples);
  refuse(head + "DimSize = 2 3 2\nTransformMatrix = 1 0 0 1 0 0 0 0 1\n" + tail, {"v.mhd: ", "in a plane"}, "v.mhd");
  refuse(head + "DimSize = 2 3 2\nDimSize = 3 2 2\n" + tail,
         {"line 4", "\"DimSize\"", "\"3 2 2\"", "\"2 3 2\"", "expected one value"}, "v.mhd");
  refuse(head + "DimSize = 2 3 2\nElementSpacing = 1 1 1\nElementSpacing = 2 3 4\n" + tail,
         {"line 5", "\"ElementSpacing\""}, "v.mhd");
  write_text(directory_ / "v.mhd", head + "DimSize = 2 3 2\nDimSize = 2 3 2\n" + tail);
  EXPECT_EQ(read_volume(directory_ / "v.mhd").at(1, 2, 1), 'l');
}

// A mirrored volume is none that MRC can tell of.
TEST_F(BadVolume, MrcCellsOfNoLength) {
  std::string bytes(1024, '\0');
  const auto put = [&bytes](std::size_t place, auto number) { std::memcpy(&bytes[place], &number, sizeof number); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(4 * axis, std::int32_t{2});
    put(28 + 4 * axis, std::int32_t{2});
    put(40 + 4 * axis, 4.0f);
  }
  bytes[212] = kHostEndian == Endian::kLittle ? '\x44' : '\x11';
  write_text(directory_ / "v.mrc", bytes + "abcdefgh");
  EXPECT_EQ(read_volume(directory_ / "v.mrc").spacing(), (Vec3{2, 2, 2}));
  for (const float length : {-4.0f, 0.0f}) {
    put(44, length);
    refuse(bytes + "abcdefgh", {"CELLA", "along y", "above 0"}, "v.mrc");
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
  refuse(with("data file: LIST\n"), {"line 6", "the lines that follow"}, "v.nhdr");
  refuse(with("data file: slice%03d.raw 1 9 1\n"), {"cannot be shared by the 9 files"}, "v.nhdr");
  refuse(with("data file: slice%03d.raw 1 2 1\n"), {"slice001.raw", "no such file"}, "v.nhdr");
  refuse(with("data file: slice%03d.raw 1 999999999 1\n"), {"line 6", "no more files"}, "v.nhdr");
  refuse(with("data file: slice%s.raw 1 2 1\n"), {"line 6", "name%03d.raw"}, "v.nhdr");
  refuse(with("data file: slice%03d.raw 1 2 0\n"), {"line 6", "name%03d.raw"}, "v.nhdr");
  refuse(with("data file:\n"), {"line 6", "file name"}, "v.nhdr");
  refuse(with("line skip: -1\n") + kSamples, {"line 6", "\"-1\""});
  refuse(with("byte skip: -2\n") + kSamples, {"line 6", "\"-2\""});
  refuse(with("line skip: 5\n") + "one\ntwo\n", {"line skip", "5", "2 lines"});
  refuse(with("byte skip: 5\n") + "123", {"end after 3 bytes", "5 bytes"});
  refuse(with("byte skip: 9223372036854775807\n") + kSamples, {"end after 12 bytes"});
  refuse(with("byte skip: -1\n") + "123", {"end after 3 bytes"});
}

}  // namespace
}  // namespace deliso
