// Legacy VTK files as VTK's own writer makes them: field data of the whole after DATASET, metadata after any array,
// arrays in fields of points and cells.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

const std::vector<std::int16_t> kTwelveShorts = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -300};
const std::string kTwelveAsText = "0 1 2 3 4 5\n6 7 8 9 10 -300 \n";
const std::string kGridLines = "DIMENSIONS 2 3 2\nSPACING 1 1 2\nORIGIN 5 0 0\n";
const std::string kMetadata = "METADATA\nCOMPONENT_NAMES\nX\nINFORMATION 1\nNAME A LOCATION B\nDATA 3\n\n";

template <class Number>
std::string big_endian_bytes(const std::vector<Number>& numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(sizeof number, '\0');
    std::memcpy(one.data(), &number, sizeof number);
    bytes += std::endian::native == std::endian::little ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

// What comes after DATASET, from its first line on.
std::string vtk_file(bool is_text, const std::string& rest) {
  return std::string("# vtk DataFile Version 4.2\nvtk output\n") + (is_text ? "ASCII" : "BINARY") +
         "\nDATASET STRUCTURED_POINTS\n" + rest;
}

std::string vtk_points(bool is_text) {
  return "POINT_DATA 12\nSCALARS s short\nLOOKUP_TABLE default\n" +
         (is_text ? kTwelveAsText : big_endian_bytes(kTwelveShorts)) + "\n";
}

// Of numbers with a line end among their bytes, of texts, of bits, of values of any type, and of nothing.
std::string vtk_field(bool is_text) {
  const std::string text = std::string(70, 'x') + "\n";
  const std::string binary = big_endian_bytes(std::vector<double>{1.5, 0x1.0A0Ap0}) + "\nnames 1 3 string\n" + "\xC3" +
                             "abc\x80" + static_cast<char>(text.size()) + text + "\xC0\nbits 1 9 bit\n\x0A\x80\n";
  return "FIELD FieldData 6\nTimeValue 1 2 double\n" +
         (is_text ? "1.5 1.25 \n" + kMetadata + "names 1 3 string\nabc\n\nd%20e f\nbits 1 9 bit\n1 0 1 1 1 0 0 0 1\n"
                  : binary) +
         "any 1 2 variant\n11 1.5\n13 a%20b\nempty 3 0 float\n\nNULL_ARRAY\n" + kMetadata;
}

class LegacyVtk : public testing::Test {
 protected:
  Volume read(const std::string& content, const std::string& array = "") {
    write_text(directory_ / "a.vtk", content);
    ReadOptions options;
    options.array = array;
    return read_placed_volume(directory_ / "a.vtk", options);
  }
  void expect_twelve(const std::string& content, const std::string& array = "") {
    const Volume volume = read(content, array);
    EXPECT_EQ(volume.grid.samples(), Samples(kTwelveShorts));
    EXPECT_EQ(volume.grid.origin(), (Vec3{5, 0, 0}));
    EXPECT_EQ(volume.grid.spacing(), (Vec3{1, 1, 2}));
  }
  void refuse(const std::string& content, std::initializer_list<std::string> parts) {
    write_text(directory_ / "a.vtk", content);
    expect_input_error([&] { read_placed_volume(directory_ / "a.vtk"); }, parts, "a.vtk");
  }
  TemporaryFolder directory_;
};

TEST_F(LegacyVtk, FieldDataOfTheWholeIsGoneOver) {
  for (const bool is_text : {true, false}) {
    SCOPED_TRACE(is_text);
    expect_twelve(vtk_file(is_text, vtk_field(is_text) + kGridLines + vtk_points(is_text)));
    expect_twelve(vtk_file(is_text, kGridLines + vtk_field(is_text) + vtk_points(is_text)));
    // After POINT_DATA its arrays are of points; those without a value for each are no samples of this grid.
    expect_twelve(vtk_file(is_text, kMetadata + kGridLines + vtk_points(is_text) + kMetadata + vtk_field(is_text)),
                  "s");
    // Keywords are read in any case.
    expect_twelve(vtk_file(is_text, "field f 1\nt 1 1 int\n" +
                                        (is_text ? "7\n" : big_endian_bytes(std::vector{7}) + "\n") + "metadata\n\n" +
                                        kGridLines + vtk_points(is_text)));
  }
}

TEST_F(LegacyVtk, ArraysOfFieldsOfPointsAreSamplesAndThoseOfCellsAreNot) {
  for (const bool is_text : {true, false}) {
    SCOPED_TRACE(is_text);
    const std::string cells = "CELL_DATA 2\n" + vtk_field(is_text) + "SCALARS c unsigned_char\nLOOKUP_TABLE default\n" +
                              (is_text ? "1 2\n" : "\x01\x02\n") + kMetadata;
    const std::string numbers = is_text ? kTwelveAsText : big_endian_bytes(kTwelveShorts) + "\n";
    const std::string names = "names 1 1 string\n" + std::string(is_text ? "a\n"
                                                                         : "\xC1"
                                                                           "a\n");
    const std::string of_points = "POINT_DATA 12\nFIELD f 2\n" + names + kMetadata + "s 1 12 short\n" + numbers;
    expect_twelve(vtk_file(is_text, kGridLines + cells + of_points));
    expect_twelve(vtk_file(is_text, kGridLines + of_points + kMetadata + cells));
    expect_twelve(vtk_file(is_text, kGridLines + vtk_points(is_text) + "FIELD f 1\nt 1 12 short\n" + numbers), "t");
  }
}

TEST_F(LegacyVtk, FieldsThatAreNoneAreRefused) {
  for (const bool is_text : {true, false}) {
    SCOPED_TRACE(is_text);
    const auto with = [&](const std::string& begin) {
      return vtk_file(is_text, begin + kGridLines + vtk_points(is_text));
    };
    refuse(with("FIELD f\n"), {"\"FIELD f\"", "FIELD with a name and a number of arrays"});
    refuse(with("FIELD f -1\n"), {"\"FIELD f -1\"", "whole numbers from 0 to 2^40"});
    refuse(with("FIELD f 1\nt 1 1\n"), {"\"t 1 1\"", "the name, the components, the number and the type"});
    refuse(with("FIELD f 1\nt 1 1 real\n"), {"\"t 1 1 real\"", "a type of numbers"});
    refuse(with("FIELD f 1\nt 1 x int\n"), {"\"t 1 x int\"", "whole numbers"});
    refuse(with("FIELD f 1\nt 1099511627776 1099511627776 int\n"), {"\"t 1099", "fewer numbers"});
    refuse(with("FIELD f 1\nt 1 1099511627776 double\n"), {is_text ? "ends within" : "the data end", "\"t\""});
    refuse(with("FIELD f 1\nt 1 1099511627776 string\n"), {is_text ? "ends within" : "the data end", "\"t\""});
    refuse(with("FIELD f 1\nt 1 1099511627776 variant\n"), {"ends within", "\"t\""});
    refuse(vtk_file(is_text, kGridLines + vtk_points(is_text) + "FIELD f 3\nNULL_ARRAY\n"),
           {"2 arrays of a FIELD should follow"});
    refuse(vtk_file(is_text, "FIELD f 1099511627776\n"), {"1099511627776 arrays of a FIELD should follow"});
    refuse(vtk_file(is_text, kMetadata), {"no line DIMENSIONS"});
  }
}

TEST_F(LegacyVtk, WhatIsCutOffInAFieldIsRefused) {
  for (const bool is_text : {true, false}) {
    const std::string head = vtk_file(is_text, ""), block = vtk_field(is_text);
    expect_twelve(head + block + kGridLines + vtk_points(is_text));
    for (std::size_t n = 0; n < block.size(); ++n) {
      write_text(directory_ / "a.vtk", head + block.substr(0, n));
      EXPECT_THROW(read_placed_volume(directory_ / "a.vtk"), InputError) << n;
    }
  }
}

}  // namespace
}  // namespace deliso
