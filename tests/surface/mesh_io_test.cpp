#include "surface/mesh_io.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "surface/mesh_io_formats.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

class MeshIo : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::path(::testing::TempDir()) / (std::string("deliso_mesh_io_") + info->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  [[nodiscard]] fs::path file(const std::string& name) const { return directory_ / name; }
  fs::path write_bytes(const std::string& name, const std::string& bytes) {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }
  static std::string read_bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // The message of the InputError that reading these bytes gives.
  std::string reading_error(const std::string& name, const std::string& bytes) {
    const fs::path path = write_bytes(name, bytes);
    try {
      read_mesh(path);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << "does not name the file: " << error.what();
      return std::string(error.what()).substr(path.string().size());
    }
    ADD_FAILURE() << "no error for:\n" << bytes;
    return "";
  }

  fs::path directory_;
};

// Coordinates of all magnitudes, with numbers that need all 17 digits.
TriangleMesh awkward_mesh(std::uint64_t seed) {
  Rng rng(seed);
  TriangleMesh mesh = testing::random_soup(rng, 200, 300);
  for (Vec3& p : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      do {
        p[axis] = std::bit_cast<double>(rng.next());
      } while (!std::isfinite(p[axis]));
    }
  }
  mesh.points[0] = {0.1, 1.0 / 3, -0.0};
  mesh.points[1] = {5e-324, 2.2250738585072014e-308, 1.7976931348623157e308};
  return mesh;
}

void expect_same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t v = 0; v < a.points.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.points[v][axis]), std::bit_cast<std::uint64_t>(b.points[v][axis]))
          << "vertex " << v << ", axis " << axis;
    }
  }
}

TEST_F(MeshIo, PlyOffAndObjKeepEveryBit) {
  const TriangleMesh mesh = awkward_mesh(11);
  for (const bool ascii : {false, true}) {
    for (const char* name : {"mesh.ply", "mesh.off", "mesh.obj", "mesh.PLY"}) {
      SCOPED_TRACE(std::string(name) + (ascii ? " as text" : ""));
      write_mesh(mesh, file(name), ascii);
      expect_same_bits(read_mesh(file(name)), mesh);
    }
  }
}

TEST_F(MeshIo, KnownPathsAreThoseThatAreWritten) {
  const TriangleMesh mesh = awkward_mesh(1);
  for (const std::string name : {"m.ply", "m.PLY", "m.off", "m.obj", "m.Stl", "m.txt", "m", "m.plyx", "ply"}) {
    bool written = true;
    try {
      write_mesh(mesh, file(name));
    } catch (const InputError& error) {
      written = std::string(error.what()).find(kMeshExtensions) == std::string::npos;
    }
    EXPECT_EQ(is_mesh_path(file(name)), written) << name;
  }
  EXPECT_TRUE(is_mesh_path("m.ply"));
  EXPECT_FALSE(is_mesh_path("m.txt"));
}

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
        // As text the shortest decimal of a float, read as a double, is near that float but not equal to it.
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(static_cast<float>(p[axis]), static_cast<float>(q[axis]));
        }
      }
    }
  }
}

TEST_F(MeshIo, StlRefusesCoordinatesBeyondFloats) {
  TriangleMesh mesh = testing::tetrahedron_mesh();
  mesh.points[2].y = 1e300;
  EXPECT_THROW(write_mesh(mesh, file("mesh.stl")), InputError);
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(MeshIo, AnAsciiStlThatCallsItselfSolidAndABinaryOneThatDoesTooAreToldApart) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  std::string bytes = stl_bytes(mesh, false);
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(parse_stl(bytes, "x").triangles.size(), 4u);
  EXPECT_EQ(parse_stl(stl_bytes(mesh, true), "x").triangles.size(), 4u);
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
  const TriangleMesh obj = read_mesh(write_bytes("a.obj",
                                                 "# a comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nvn 0 0 1\n"
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

TEST_F(MeshIo, ErrorsNameThePlaceAndTheCulprit) {
  EXPECT_EQ(reading_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"),
            ", line 5: expected a y coordinate (a finite number), found 'nan'");
  EXPECT_EQ(reading_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            ", line 6: expected an index below 3, found '3'");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"),
            ", line 5: expected an index of at most 3, found 4");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nv 1 inf 0\n"), ", line 2: expected a finite coordinate, found 'inf'");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nf 0 1 1\n"), ", line 2: expected the index of a point, found '0'");
  EXPECT_EQ(reading_error("a.obj", "v 0 0 0\nf 1 1 -2\n"), ", line 2: expected the index of a point, found '-2'");
  EXPECT_EQ(reading_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"),
            ", line 4: expected a PLY type (char, uchar, short, ushort, int, uint, float or double), found 'half'");
  EXPECT_NE(reading_error("a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n").find("line 4"),
            std::string::npos);
  // Cut, negative and NaN binary data.
  const std::string bytes = ply_bytes(testing::tetrahedron_mesh(), false);
  EXPECT_NE(reading_error("a.ply", bytes.substr(0, bytes.size() - 1)).find("but the file ends at byte"),
            std::string::npos);
  std::string negative = bytes;
  negative.back() = '\xFF';
  EXPECT_NE(reading_error("a.ply", negative).find("expected the index of a vertex, found -"), std::string::npos);
  std::string not_finite = bytes;
  not_finite.replace(bytes.find("end_header\n") + 11 + 6, 2, "\xF8\x7F");
  EXPECT_NE(reading_error("a.ply", not_finite).find("an x coordinate (a finite number)"), std::string::npos);
}

TEST_F(MeshIo, PromisesOfHugeCountsDoNotTakeMemory) {
  reading_error("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n");
  reading_error("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n1 2 3\n");
  reading_error("a.ply",
                "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
                "\xFF\xFF\xFF\xFF");
  reading_error("a.stl", std::string(80, ' ') + "\xFF\xFF\xFF\xFF");
}

// Every beginning of a file, and every file with one byte changed, is a mesh or an InputError.
TEST_F(MeshIo, DamagedFilesNeverDoWorseThanAnInputError) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  using Parser = TriangleMesh (*)(std::string_view, const std::string&);
  const std::vector<std::pair<std::string, Parser>> cases = {
      {ply_bytes(mesh, false), parse_ply}, {ply_bytes(mesh, true), parse_ply},  {off_bytes(mesh), parse_off},
      {obj_bytes(mesh), parse_obj},        {stl_bytes(mesh, false), parse_stl}, {stl_bytes(mesh, true), parse_stl}};
  for (const auto& [bytes, parse] : cases) {
    std::int64_t errors = 0;
    const auto try_parse = [&, parse = parse](std::string_view damaged) {
      try {
        const TriangleMesh found = parse(damaged, "damaged");
        for (const auto& t : found.triangles) {
          for (const std::uint32_t v : t) ASSERT_LT(v, found.points.size());
        }
        for (const Vec3& p : found.points) ASSERT_TRUE(is_finite(p));
      } catch (const InputError&) {
        ++errors;
      }
    };
    // A copy of its own size, so that reading past the end is seen.
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      try_parse(std::string_view(std::vector<char>(bytes.begin(), bytes.begin() + std::ptrdiff_t(size)).data(), size));
    }
    EXPECT_GT(errors, 0);
    Rng rng(5);
    for (int i = 0; i < 3000; ++i) {
      std::string damaged = bytes;
      damaged[rng.below(damaged.size())] = static_cast<char>(rng.below(256));
      try_parse(damaged);
    }
  }
}

TEST_F(MeshIo, WritesWholeOrNotAtAll) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  EXPECT_THROW(write_mesh(mesh, file("missing") / "mesh.ply"), InputError);
  EXPECT_THROW(write_mesh(mesh, file("mesh.xyz")), InputError);
  EXPECT_THROW(read_mesh(file("mesh.xyz")), InputError);
  EXPECT_THROW(read_mesh(file("missing.ply")), InputError);
  fs::create_directory(file("directory.ply"));
  EXPECT_THROW(write_mesh(mesh, file("directory.ply")), InputError);
  EXPECT_THROW(read_mesh(file("directory.ply")), InputError);
  EXPECT_TRUE(fs::is_empty(file("directory.ply")));
  fs::remove(file("directory.ply"));
  EXPECT_TRUE(fs::is_empty(directory_)) << "a temporary file was left";

  // Over an existing file.
  write_bytes("mesh.ply", "old");
  write_mesh(mesh, file("mesh.ply"));
  expect_same_bits(read_mesh(file("mesh.ply")), mesh);
}

TEST_F(MeshIo, TheEmptyMeshIsAMesh) {
  for (const char* name : {"mesh.ply", "mesh.off", "mesh.obj", "mesh.stl"}) {
    for (const bool ascii : {false, true}) {
      write_mesh({}, file(name), ascii);
      expect_same_bits(read_mesh(file(name)), {});
    }
  }
}

}  // namespace
}  // namespace deliso
