// What each mesh format has of its own, as it is written here and as others write it.
#include "surface/mesh/io/formats.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_files.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

using testing::MeshIo;

TEST_F(MeshIo, BinaryPlyHasTheDocumentedLayout) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  write_mesh(mesh, file("mesh.ply"));
  const std::string bytes = read_bytes(file("mesh.ply"));
  const std::size_t body = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_NE(bytes.find("property double x\nproperty double y\nproperty double z\nelement face 4\n"), bytes.npos);
  EXPECT_EQ(bytes.size(), body + 4 * 24 + 4 * 13);
  // x of vertex 1 is 1.0 = 0x3FF0000000000000, lowest byte first.
  EXPECT_EQ(bytes.substr(body + 24, 8), std::string("\0\0\0\0\0\0\xF0\x3F", 8));
}

TEST_F(MeshIo, StlMergesCornersAndRoundsToFloats) {
  const TriangleMesh mesh = testing::sphere_mesh(3);
  for (const bool ascii : {false, true}) {
    write_mesh(mesh, file("mesh.stl"), ascii);
    const TriangleMesh back = read_mesh(file("mesh.stl"));
    ASSERT_EQ(back.points.size(), mesh.points.size());
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = mesh.points[mesh.triangles[t][i]], &q = back.points[back.triangles[t][i]];
        // As text, too, with all digits: the shortest decimal of a float, read as a double, is another number.
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(static_cast<float>(p[axis]), q[axis]);
      }
    }
  }
}

TEST_F(MeshIo, StlRefusesCoordinatesBeyondFloats) {
  TriangleMesh mesh = testing::tetrahedron_mesh();
  mesh.points[2].y = 1e300;
  EXPECT_THROW(write_mesh(mesh, file("mesh.stl")), InputError);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(MeshIo, AnAsciiStlThatCallsItselfSolidAndABinaryOneThatDoesTooAreToldApart) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  std::string bytes = stl_bytes(mesh, false);
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(parse_stl(bytes, "x").triangles.size(), 4u);
  EXPECT_EQ(parse_stl(stl_bytes(mesh, true), "x").triangles.size(), 4u);
}

TEST_F(MeshIo, AnAsciiStlInCapitalsIsRead) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  std::string text = stl_bytes(mesh, true);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  ASSERT_TRUE(text.starts_with("SOLID"));
  EXPECT_EQ(parse_stl(text, "x").points, parse_stl(stl_bytes(mesh, true), "x").points);
  EXPECT_EQ(mesh_format_of_content(text, text.size()), MeshFormat::kStl);
  text.replace(text.find("OUTER"), 5, "inner");
  try {
    parse_stl(text, "x");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "x, line 3: expected outer, found 'inner'");
  }
}

TEST_F(MeshIo, ReadsForeignPly) {
  // Big endian, floats, extra elements and properties, lists of other types, quads, CRLF in the header.
  std::string bytes =
      "ply\r\nformat binary_big_endian 1.0\r\ncomment made by hand\r\nelement material 2\r\nproperty uchar kind\r\n"
      "property list ushort float weights\r\nelement vertex 4\r\nproperty uchar red\r\nproperty float x\r\n"
      "property float y\r\nproperty float z\r\nproperty list uchar short tags\r\nelement face 1\r\n"
      "property double area\r\nproperty list int ushort vertex_index\r\nend_header\r\n";
  const auto big = [&bytes](auto value) {
    auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    bytes.append(raw.rbegin(), raw.rend());
  };
  for (int i = 0; i < 2; ++i) {
    big(std::uint8_t{7});
    big(std::uint16_t{2});
    big(1.5F);
    big(2.5F);
  }
  for (const auto& [x, y] : {std::pair{0.F, 0.F}, {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
    big(std::uint8_t{255});
    big(x);
    big(y);
    big(0.25F);
    big(std::uint8_t{1});
    big(std::int16_t{-3});
  }
  big(1.0);
  big(std::int32_t{4});
  for (std::uint16_t v = 0; v < 4; ++v) big(v);
  const TriangleMesh mesh = read_mesh(write_bytes("mesh.ply", bytes));
  ASSERT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[2], (Vec3{1, 1, 0.25}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(MeshIo, ReadsForeignTextFormats) {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  const TriangleMesh obj =
      read_mesh(write_bytes("a.obj",
                            "# a comment\nmtllib x.mtl\nv 0 0 0 \\\n1\nv 1 0 0 0.5 0.5 0.5\nvn 0 0 1\n"
                            "v +1 1e0 0\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\nv 0 1 0\nf -4//1 -2//1 \\\n"
                            "-1//1\ns off\nf 1/1 2/1 3/1 4/1"));
  EXPECT_EQ(obj.points.size(), 4u);
  EXPECT_EQ(obj.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}}));
  const TriangleMesh off = read_mesh(write_bytes("a.off",
                                                 "COFF # colours\n\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n"
                                                 "# between\n1 1 0 0 0 0 0\n0 1 0 1 1 1 1\n4 0 1 2 3 0.5 0.5 0.5\n"));
  EXPECT_EQ(off.points.size(), 4u);
  EXPECT_EQ(off.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

// What is not read is known and skipped, over line ends too; what is unknown is no OBJ file.
TEST_F(MeshIo, StatementsThatAreNoneOfObjAreRefused) {
  const TriangleMesh mesh = read_mesh(write_bytes("a.obj",
                                                  "\xEF\xBB\xBF# a comment\n\no a b\ng c\ns 1\nusemtl m\nl 1 2\n"
                                                  "curv2 1 2 \\\n3 4\\\n5 6\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh.points.size(), 3u);
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(reading_error("a.obj", "hello, this is no mesh\n"),
            ", line 1: expected a statement of the OBJ format (v, f, vn, g, usemtl, ...), found 'hello,'");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nvn 0 0 1\n1 2 3\n"),
            ", line 3: expected a statement of the OBJ format (v, f, vn, g, usemtl, ...), found '1'");
  // As with the line ends of old systems: all of the file is one line.
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"),
            ", line 1: expected a number or the end of the line after the coordinates, found 'v'");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/x 2/?/! 3\n"),
            ", line 4: expected the index of a point, found '1/x'");
}

TEST_F(MeshIo, WhatFollowsTheLastElementOfAPlyFileIsRefused) {
  const std::string text = ply_bytes(testing::tetrahedron_mesh(), true);
  EXPECT_EQ(read_mesh(write_bytes("a.ply", text + " \n\n")).triangles.size(), 4u);
  EXPECT_EQ(reading_error("a.ply", text + "3 0 1 2\n"),
            ", line 19: expected the end of the file after the last element, found '3'");
  const std::string bytes = ply_bytes(testing::tetrahedron_mesh(), false);
  EXPECT_EQ(reading_error("a.ply", bytes + "xyz"), ", before byte " + std::to_string(bytes.size()) +
                                                       ": expected the end of the file after the last element, found "
                                                       "3 bytes more");
}

TEST(MeshFormatOfContent, ObjIsKnownByItsFirstPoint) {
  for (const std::string head : {"", "# made by hand\n\nmtllib a.mtl\r\no Body\nvn 0 0 1\n", "\xEF\xBB\xBF#\n"}) {
    EXPECT_EQ(mesh_format_of_content(head + "v 0 1e-3 -2\n", 99), MeshFormat::kObj) << head;
    for (const std::string other : {"v\n", "v 1 2\n3\n", "v one two three\n", "1 2 3\n", "version 1 2 3\n", ""})
      EXPECT_FALSE(mesh_format_of_content(head + other, 99)) << head << other;
  }
  EXPECT_FALSE(mesh_format_of_content("# words\nsome text\nv 1 2 3\n", 99));
}

}  // namespace
}  // namespace deliso
