// Meshes that are written and read, in all formats: whole or not at all, and damage is named.
#include "surface/mesh/io/mesh_io.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "surface/mesh/io/formats.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_files.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

using testing::MeshIo;

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

TEST_F(MeshIo, FormatsOfDoublesKeepEveryBit) {
  const TriangleMesh mesh = awkward_mesh(11);
  for (const bool ascii : {false, true}) {
    for (const char* name : {"mesh.ply", "mesh.off", "mesh.obj", "mesh.PLY", "mesh.mesh", "mesh.vtk", "mesh.vtp"}) {
      SCOPED_TRACE(std::string(name) + (ascii ? " as text" : ""));
      write_mesh(mesh, file(name), ascii);
      expect_same_bits(read_mesh(file(name)), mesh);
    }
  }
}

TEST_F(MeshIo, KnownPathsAreThoseThatAreWritten) {
  const TriangleMesh mesh = awkward_mesh(1);
  for (const std::string name : {"m.ply", "m.PLY", "m.off", "m.obj", "m.Stl", "m.mesh", "m.msh", "m.smesh", "m.vtk",
                                 "m.VTP", "m.txt", "m", "m.plyx", "ply"}) {
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
  const auto vtk = [](std::string_view bytes, const std::string& name) { return parse_legacy_vtk(bytes, name); };
  const auto vtp = [](std::string_view bytes, const std::string& name) { return parse_vtp(bytes, name); };
  MeshFileOptions text;
  text.ascii = true;
  text.comments = {"one", "another one"};
  MeshFileOptions binary = text;
  binary.ascii = false;
  const std::vector<std::pair<std::string, Parser>> cases = {
      {legacy_vtk_bytes(mesh, text), vtk}, {legacy_vtk_bytes(mesh, binary), vtk},  {vtp_bytes(mesh, text), vtp},
      {vtp_bytes(mesh, binary), vtp},      {medit_bytes(mesh, text), parse_medit}, {ply_bytes(mesh, false), parse_ply},
      {ply_bytes(mesh, true), parse_ply},  {off_bytes(mesh), parse_off},           {obj_bytes(mesh), parse_obj},
      {stl_bytes(mesh, false), parse_stl}, {stl_bytes(mesh, true), parse_stl}};
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
  EXPECT_TRUE(fs::is_empty(folder_.path())) << "a temporary file was left";

  // Over an existing file.
  write_bytes("mesh.ply", "old");
  write_mesh(mesh, file("mesh.ply"));
  expect_same_bits(read_mesh(file("mesh.ply")), mesh);
}

TEST_F(MeshIo, WhatIsNoFileIsNamed) {
  const auto message = [this](const char* name) {
    try {
      read_mesh(file(name));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  fs::create_directory(file("directory.ply"));
  ASSERT_EQ(::mkfifo(file("pipe.ply").c_str(), 0600), 0);
  EXPECT_EQ(message("missing.ply"), file("missing.ply").string() + ": there is no such file");
  EXPECT_EQ(message("directory.ply"), file("directory.ply").string() + ": this is not a regular file");
  EXPECT_EQ(message("pipe.ply"), file("pipe.ply").string() + ": this is not a regular file");  // and did not wait
  EXPECT_THROW(write_mesh(testing::tetrahedron_mesh(), file("pipe.ply")), InputError);
  EXPECT_TRUE(fs::is_fifo(file("pipe.ply")));
}

TEST_F(MeshIo, ALinkStaysAndItsTargetIsReplaced) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  fs::create_directory(file("folder"));
  write_bytes("folder/target.ply", "old");
  fs::create_symlink(fs::path("folder") / "target.ply", file("link.ply"));
  write_mesh(mesh, file("link.ply"));
  EXPECT_TRUE(fs::is_symlink(file("link.ply")));
  EXPECT_FALSE(fs::is_symlink(file("folder") / "target.ply"));
  expect_same_bits(read_mesh(file("folder") / "target.ply"), mesh);
}

// The target need not exist, and a link may lead to another one.
TEST_F(MeshIo, ALinkLeadsToAFileThatIsMade) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  fs::create_directory(file("folder"));
  fs::create_symlink(fs::path("folder") / "new.ply", file("link.ply"));
  fs::create_symlink("link.ply", file("first.ply"));
  write_mesh(mesh, file("first.ply"));
  EXPECT_TRUE(fs::is_symlink(file("link.ply")));
  EXPECT_TRUE(fs::is_symlink(file("first.ply")));
  expect_same_bits(read_mesh(file("folder") / "new.ply"), mesh);
  fs::create_symlink("round.ply", file("round.ply"));
  EXPECT_THROW(write_mesh(mesh, file("round.ply")), InputError);
  fs::create_symlink(fs::path("none") / "new.ply", file("astray.ply"));
  EXPECT_THROW(write_mesh(mesh, file("astray.ply")), InputError);
  EXPECT_TRUE(fs::is_symlink(file("astray.ply")));
}

TEST_F(MeshIo, AFileThatIsReplacedKeepsItsPermissions) {
  const TriangleMesh mesh = testing::tetrahedron_mesh();
  constexpr auto kPrivate = fs::perms::owner_read | fs::perms::owner_write;
  write_bytes("private.ply", "old");
  fs::permissions(file("private.ply"), kPrivate);
  write_mesh(mesh, file("private.ply"));
  EXPECT_EQ(fs::status(file("private.ply")).permissions(), kPrivate);
  expect_same_bits(read_mesh(file("private.ply")), mesh);
}

TEST_F(MeshIo, AWriteProtectedFileStays) {
  write_bytes("kept.ply", "old");
  fs::permissions(file("kept.ply"), fs::perms::owner_read);
  if (::access(file("kept.ply").c_str(), W_OK) == 0) GTEST_SKIP() << "this user may write everything";
  EXPECT_THROW(write_mesh(testing::tetrahedron_mesh(), file("kept.ply")), InputError);
  EXPECT_EQ(fs::file_size(file("kept.ply")), 3u);
  EXPECT_EQ(fs::status(file("kept.ply")).permissions(), fs::perms::owner_read);
}

TEST_F(MeshIo, TheEmptyMeshIsAMesh) {
  for (const char* name : {"mesh.ply", "mesh.off", "mesh.obj", "mesh.stl", "mesh.mesh", "mesh.vtk", "mesh.vtp"}) {
    for (const bool ascii : {false, true}) {
      write_mesh({}, file(name), ascii);
      expect_same_bits(read_mesh(file(name)), {});
    }
  }
}

}  // namespace
}  // namespace deliso
