// Any file as a mesh, in every format that is read; what was read is written in every format, and verified where it is
// small. DELISO_FUZZ_FORMAT names an extension: every file is then read as that format, and not verified, so that all
// time goes to one reader.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/verification/verification.h"
#include "tests/fuzz/fuzz_input.h"

namespace deliso::fuzz {
namespace {

std::optional<MeshFormat> only_format() {
  const char* const name = std::getenv("DELISO_FUZZ_FORMAT");
  return name == nullptr ? std::nullopt : mesh_format_named(name);
}

std::optional<TriangleMesh> read(const std::filesystem::path& path) {
  try {
    return read_mesh_file(path, only_format()).mesh;
  } catch (const InputError& error) {
    require_sentence(error.what());
    return std::nullopt;
  }
}

void require_valid(const TriangleMesh& mesh) {
  for (const Vec3& p : mesh.points) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "points are finite");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) require(v < mesh.points.size(), "triangles name vertices that exist");
  }
  require(mesh.labels.empty() || mesh.labels.size() == mesh.triangles.size(), "all triangles have labels, or none");
}

bool are_equal(const TriangleMesh& a, const TriangleMesh& b) {
  return a.points == b.points && a.triangles == b.triangles;
}

// Text and bytes that hold doubles give the same mesh back.
void require_round_trip(const TriangleMesh& mesh) {
  require(are_equal(mesh, parse_ply(ply_bytes(mesh, false), "ply")), "binary PLY keeps a mesh");
  require(are_equal(mesh, parse_ply(ply_bytes(mesh, true), "ply")), "PLY as text keeps a mesh");
  require(are_equal(mesh, parse_off(off_bytes(mesh), "off")), "OFF keeps a mesh");
  require(are_equal(mesh, parse_obj(obj_bytes(mesh), "obj")), "OBJ keeps a mesh");
  require(are_equal(mesh, parse_medit(medit_bytes(mesh), "mesh")), "Medit keeps a mesh");
  for (const bool ascii : {false, true}) {
    MeshFileOptions options;
    options.ascii = ascii;
    options.comments = {"one", "another"};
    MeshComments comments;
    require(are_equal(mesh, parse_legacy_vtk(legacy_vtk_bytes(mesh, options), "vtk", &comments)), "VTK keeps a mesh");
    require(comments == options.comments, "VTK keeps comments");
    require(are_equal(mesh, parse_vtp(vtp_bytes(mesh, options), "vtp")), "VTP keeps a mesh");
    try {
      const TriangleMesh again = parse_stl(stl_bytes(mesh, ascii), "stl");
      require(again.triangles.size() == mesh.triangles.size(), "STL keeps the number of triangles");
    } catch (const InputError& error) {
      require_sentence(error.what());  // beyond the range of floats
    }
  }
}

// Formats that are only written: whatever the mesh, the bytes are made, or one sentence says why not.
void require_written(const TriangleMesh& mesh) {
  require(!gmsh_bytes(mesh).empty() && !smesh_bytes(mesh).empty(), "Gmsh's and TetGen's formats hold any mesh");
  try {
    require(glb_bytes(mesh).starts_with("glTF"), "GLB begins as it must");
  } catch (const InputError& error) {
    require_sentence(error.what());  // beyond the range of floats
  }
}

// A ball in a box of 6 x 5 x 4 samples around the origin.
const ScalarGrid& ball() {
  static const ScalarGrid kBall = [] {
    std::vector<float> samples;
    for (int n = 0; n < 120; ++n) {
      const double x = n % 6 - 2.5, y = n / 6 % 5 - 2.0, z = n / 30 - 1.5;
      samples.push_back(static_cast<float>(1.3 - std::sqrt(x * x + y * y + z * z)));
    }
    return ScalarGrid({6, 5, 4}, SampleArray<float>(std::move(samples)), {1, 1, 1}, {-2.5, -2, -1.5});
  }();
  return kBall;
}

void run(std::string_view input) {
  constexpr std::size_t kMostWritten = 200, kMostVerified = 16, kVerifyOne = 8;
  InputFiles files(input);
  const std::optional<TriangleMesh> mesh = read(files.first());
  if (!mesh) return;
  require_valid(*mesh);
  if (mesh->points.size() + mesh->triangles.size() > kMostWritten) return;
  require_round_trip(*mesh);
  require_written(*mesh);
  // The verifier takes as long as all the rest on some ten inputs.
  if (only_format() || mesh->triangles.size() > kMostVerified || input.size() % kVerifyOne != 0) return;
  const Verification v = verify_mesh(*mesh, ball(), 0);
  require(v.proven == v.failures.empty(), "what is not proven says why");
}

}  // namespace
}  // namespace deliso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deliso::fuzz::run(deliso::fuzz::text_of(data, size));
  return 0;
}
