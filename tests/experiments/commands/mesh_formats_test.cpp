// Meshes of every format through the program: verified by the promise that they name, described by info, through
// standard input and output; and what VTK files say of each vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

bool has_text(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class MeshFormats : public ::testing::Test {
 protected:
  MeshFormats() { EXPECT_EQ(run_deliso({"generate", "shells", "--size", "24", "-o", volume_}).exit_code, 0); }
  // Meshes the shells, closed.
  ProgramResult mesh(const std::string& output, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"mesh", volume_, "--isovalue", "100.5",
                                          "-o",   output,  "--set",      "boundary=closed"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  // A command line of the shell, with $D for the program and $F for the folder.
  [[nodiscard]] ProgramResult shell(const std::string& line) const {
    return run_program_at("/bin/sh", {"-c", "D=" DELISO_PROGRAM "; F=" + folder_.path().string() + "; " + line});
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd";
};

TEST_F(MeshFormats, VerifyTakesItsBoundFromEveryFormatThatIsRead) {
  for (const std::string format : {"ply", "off", "obj", "stl", "mesh", "vtk", "vtp"}) {
    for (const bool ascii : {false, true}) {
      SCOPED_TRACE(format + (ascii ? " as text" : ""));
      const std::string path = folder_ / ("m." + format), report = folder_ / "r.json";
      std::vector<std::string> more = {"--set", "promise.max_distance=0.75"};
      if (ascii) more.emplace_back("--ascii");
      ASSERT_EQ(mesh(path, more).exit_code, 0);
      const ProgramResult result =
          run_deliso({"verify", path, volume_, "--isovalue", "100.5", "--closed", "--report", report});
      EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
      EXPECT_EQ(read_json(report)["promise"]["max_distance"], 0.75);
    }
  }
}

// A vertex of no triangle, far outside the box, is no part of the surface: told, and not held against it.
TEST_F(MeshFormats, VerifyTellsOfVerticesWithoutTriangles) {
  const std::string path = folder_ / "m.obj";
  ASSERT_EQ(mesh(path).exit_code, 0);
  const auto verify = [&] { return run_deliso({"verify", path, volume_, "--isovalue", "100.5", "--closed"}); };
  EXPECT_FALSE(has_text(verify().err, "no triangle"));
  write_file(path, read_file(path) + "v 1000000 0 0\n");
  const ProgramResult one = verify();
  EXPECT_EQ(one.exit_code, 0) << one.out << one.err;
  EXPECT_TRUE(has_text(one.err, "1 vertex belongs to no triangle: it is no part of the surface")) << one.err;
  write_file(path, read_file(path) + "v 0 0 0\n");
  EXPECT_TRUE(has_text(verify().err, "2 vertices belong to no triangle: they are no part of the surface"));
}

TEST_F(MeshFormats, StandardInputIsOfAKnownFormatAndStandsAlone) {
  EXPECT_EQ(shell("$D info - --volume-format NRRD < $F/v.nrrd").exit_code, 0);
  EXPECT_EQ(shell("$D info - --volume-format nrrd.gz < $F/v.nrrd").exit_code, 0);
  // Whatever the content tells.
  const ProgramResult unknown = shell("$D info - --volume-format foo < $F/v.nrrd");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(has_text(unknown.err, "--volume-format: expected nrrd, nhdr, nii, ")) << unknown.err;
  EXPECT_TRUE(has_text(unknown.err, " or raw, found 'foo'")) << unknown.err;
  const std::string header = "NRRD0001\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n";
  write_file(folder_ / "marked.nrrd", "\xEF\xBB\xBF" + header + "\n12345678");
  EXPECT_EQ(shell("$D info - < $F/marked.nrrd").exit_code, 0);
  // A pair of NIfTI files begins with a header whose magic, at byte 344, is "ni1".
  std::string nifti(348, '\0');
  nifti[0] = 92, nifti[1] = 1, nifti[40] = 3, nifti[42] = nifti[44] = nifti[46] = 2, nifti[70] = 2, nifti[72] = 8;
  for (const std::size_t spacing : {80u, 84u, 88u}) nifti.replace(spacing, 4, std::string("\0\0\x80\x3F", 4));  // 1
  nifti.replace(344, 3, "ni1");
  write_file(folder_ / "d.hdr", nifti);
  write_file(folder_ / "d.nhdr", header + "data file: d.raw\n");
  write_file(folder_ / "d.mhd", "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = d.raw\n");
  write_file(folder_ / "d.raw", "12345678");
  write_file(folder_ / "d.img", "12345678");
  for (const std::string name : {"d.nhdr", "d.mhd", "d.hdr"}) {
    EXPECT_EQ(run_deliso({"info", folder_ / name}).exit_code, 0) << run_deliso({"info", folder_ / name}).err;
    const ProgramResult refused = shell("cat $F/" + name + " | $D info -");
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_EQ(refused.err,
              "deliso: standard input: the header has its samples in another file, which is looked for beside the "
              "header's: give the name of the header's file\n");
  }
}

TEST_F(MeshFormats, InfoDescribesAMeshAndTheReportItsComponents) {
  ASSERT_EQ(mesh(folder_ / "m.vtp", {"--report", folder_ / "r.json"}).exit_code, 0);
  const ProgramResult text = run_deliso({"info", folder_ / "m.vtp"});
  EXPECT_TRUE(has_text(text.out, "enclosed volume") && has_text(text.out, "volume v.nrrd") &&
              has_text(text.out, "closed"))
      << text.out;
  const Json info = parse_json(run_deliso({"info", folder_ / "m.vtp", "--json"}).out, "info");
  const Json report = read_json(folder_ / "r.json");
  EXPECT_EQ(info["surface"], report["surface"]);
  EXPECT_EQ(info["vertices"], report["vertices"]);
  EXPECT_EQ(info["components"], 4);
  EXPECT_EQ(info["closed"], true);
  EXPECT_EQ(info["oriented"], true);
  EXPECT_EQ(info["comments"].size(), 6u);  // the lines of mesh_comments(), and that the boundary is closed
  double sum = 0;
  int cavities = 0;
  for (const Json& component : info["surface"]["components"]) {
    sum += component["enclosed_volume"].get<double>();
    cavities += component["enclosed_volume"] < 0 ? 1 : 0;
  }
  EXPECT_NEAR(sum, info["surface"]["enclosed_volume"].get<double>(), 1e-9 * sum);
  EXPECT_EQ(cavities, 1);
  // A .vtk file is a volume or a mesh, as its content says.
  ASSERT_EQ(mesh(folder_ / "m.vtk").exit_code, 0);
  EXPECT_TRUE(has_text(run_deliso({"info", folder_ / "m.vtk"}).out, "triangles"));
  EXPECT_EQ(run_deliso({"info", folder_ / "m.msh"}).exit_code, 2);
  const std::string packed = folder_ / "m.ply.gz";
  write_file(packed, "packed");
  EXPECT_EQ(run_deliso({"info", packed}).err,
            "deliso: " + packed + ": meshes are not read packed, expected the unpacked file (as by gunzip)\n");
}

TEST_F(MeshFormats, StandardInputAndOutputAreVolumesMeshesAndReports) {
  ASSERT_EQ(mesh(folder_ / "m.ply").exit_code, 0);
  const std::string run = "mesh - --isovalue 100.5 --set boundary=closed";
  EXPECT_EQ(shell("cat $F/v.nrrd | $D " + run + " -o - > $F/out.ply").exit_code, 0);
  EXPECT_EQ(read_mesh(folder_ / "out.ply").points, read_mesh(folder_ / "m.ply").points);
  EXPECT_EQ(shell("$D " + run + " -o - --format vtp < $F/v.nrrd > $F/out.vtp").exit_code, 0);
  EXPECT_EQ(read_mesh(folder_ / "out.vtp").points, read_mesh(folder_ / "m.ply").points);
  const ProgramResult verified = shell("cat $F/m.ply | $D verify - $F/v.nrrd --isovalue 100.5 --closed");
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_TRUE(has_text(shell("cat $F/out.vtp | $D info -").out, "VTP"));
  EXPECT_TRUE(has_text(shell("cat $F/v.nrrd | $D info -").out, "NRRD"));
  const ProgramResult raw = shell("tail -c 13824 $F/raw | $D info - --volume-format raw --dims 24,24,24 --type u8");
  EXPECT_EQ(raw.exit_code, 2);  // there is no such file: nothing comes
  EXPECT_EQ(shell("$D info - < /dev/null").err, "deliso: standard input is empty\n");
  EXPECT_EQ(shell("cat /dev/null | $D verify - $F/v.nrrd --isovalue 1").err, "deliso: standard input is empty\n");
  const ProgramResult report = mesh(folder_ / "x.ply", {"--report", "-"});
  EXPECT_EQ(parse_json(report.out, "report")["components"], 4);
  EXPECT_TRUE(has_text(report.err, "proven"));
  EXPECT_EQ(shell("$D generate torus --size 12 -o - | $D topology - --isovalue 0.7").exit_code, 0);
  // One stream, one use; and what is no volume is named.
  EXPECT_TRUE(has_text(mesh("-", {"--report", "-"}).err, "--report: standard output is that of -o already"));
  EXPECT_TRUE(has_text(shell("$D verify - - --isovalue 1").err, "standard input is that of MESH already"));
  EXPECT_TRUE(has_text(shell("echo hello | $D info -").err, "standard input: its beginning tells no format"));
  EXPECT_TRUE(has_text(shell("echo hello | $D verify - $F/v.nrrd --isovalue 1").err, "expected --format"));
  EXPECT_TRUE(has_text(mesh(folder_ / "x.foo").err, ".vtp or .glb, found"));
  EXPECT_TRUE(has_text(mesh(folder_ / "x.ply", {"--msh-version", "3"}).err, "expected 4.1 or 2.2, found '3'"));
}

TEST_F(MeshFormats, EveryFormatThatIsReadIsToldFromStandardInput) {
  for (const std::string format : {"ply", "off", "obj", "stl", "mesh", "vtk", "vtp"}) {
    SCOPED_TRACE(format);
    const std::string made = "$D mesh $F/v.nrrd --isovalue 100.5 --set boundary=closed -o - --quiet --format " + format;
    const ProgramResult verified = shell(made + " | $D verify - $F/v.nrrd --isovalue 100.5");
    EXPECT_EQ(verified.exit_code, 0) << verified.err;
  }
}

TEST_F(MeshFormats, OptionsOfVolumesAreRefusedForMeshes) {
  ASSERT_EQ(mesh(folder_ / "m.ply").exit_code, 0);
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{{"--smooth", "3"},
                                                                                      {"--region", "0:3,0:3,0:3"},
                                                                                      {"--channel", "7"},
                                                                                      {"--array", "a"},
                                                                                      {"--dims", "4,4,4"},
                                                                                      {"--type", "u8"},
                                                                                      {"--endian", "big"},
                                                                                      {"--spacing", "1,1,1"},
                                                                                      {"--skip", "3"}}) {
    const ProgramResult result = run_deliso({"info", folder_ / "m.ply", option[0], option[1]});
    EXPECT_EQ(result.exit_code, 2) << option[0];
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "deliso: " + option[0] + ": for volumes alone, but " + (folder_ / "m.ply") + " is a mesh\n");
  }
  EXPECT_TRUE(has_text(shell("$D info - --smooth 3 --skip 2 < $F/m.ply").err,
                       "--smooth, --skip: for volumes alone, but standard input is a mesh"));
  EXPECT_TRUE(has_text(shell("$D info - --format ply --volume-format nrrd < $F/m.ply").err, "expected one of them"));
}

// The numbers of an array of a legacy VTK file as text.
std::vector<double> vtk_array(const std::string& text, const std::string& section, const std::string& name) {
  std::istringstream words(text.substr(text.find("\n" + section + " ")));
  std::size_t width = 0, count = 0;
  std::string type;
  for (std::string word; words >> word && word != name;) {
  }
  words >> width >> count >> type;
  std::vector<double> numbers(width * count);
  for (double& number : numbers) words >> number;
  EXPECT_TRUE(words) << name;
  return numbers;
}

// A linear field of the world in a volume that is rotated, reflected and unequally spaced: its gradient is known.
TEST_F(MeshFormats, GradientsOfVtkFilesAreThoseOfTheWorld) {
  const Vec3 slope{0.5, -1.25, 2};
  std::ostringstream file;
  file << "NRRD0005\ntype: double\ndimension: 3\nsizes: 8 8 8\nencoding: ascii\nspace dimension: 3\n"
       << "space directions: (0.75,1,0) (-2,1.5,0) (0,0,-1.5)\nspace origin: (-20,33,7)\n\n";
  double middle = 0;
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 8; ++i) {
        const Vec3 p = Vec3{-20, 33, 7} + i * Vec3{0.75, 1, 0} + j * Vec3{-2, 1.5, 0} + k * Vec3{0, 0, -1.5};
        file << dot(slope, p) << '\n';
        middle += dot(slope, p) / 512;
      }
    }
  }
  write_file(folder_ / "ramp.nrrd", file.str());
  const ProgramResult result = run_deliso(
      {"mesh", folder_ / "ramp.nrrd", "--isovalue", Json(middle + 0.01).dump(), "-o", folder_ / "m.vtk", "--ascii"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = read_file(folder_ / "m.vtk");
  const std::vector<double> gradient = vtk_array(text, "POINT_DATA", "gradient");
  ASSERT_GT(gradient.size(), 30u);
  for (std::size_t i = 0; i < gradient.size(); ++i) EXPECT_NEAR(gradient[i], slope[i % 3], 1e-3);
  const TriangleMesh mesh = read_mesh(folder_ / "m.vtk");
  for (const auto& [a, b, c] : mesh.triangles)
    EXPECT_LT(dot(slope, cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])), 0);
  // A plane has no distance from its triangles, but for those whose circumcenters are outside the box.
  const std::vector<double> h = vtk_array(text, "CELL_DATA", "h");
  EXPECT_GT(std::count_if(h.begin(), h.end(), [](double value) { return std::abs(value) < 1e-3; }),
            static_cast<std::ptrdiff_t>(h.size() * 3 / 4));
}

TEST_F(MeshFormats, FieldsOfVtkFilesSayWhatTheySay) {
  ASSERT_EQ(mesh(folder_ / "m.vtk", {"--ascii", "--stage1-out", folder_ / "s.ply"}).exit_code, 0);
  const std::string text = read_file(folder_ / "m.vtk");
  const TriangleMesh whole = read_mesh(folder_ / "m.vtk"), stage1 = read_mesh(folder_ / "s.ply");
  const std::vector<double> stage = vtk_array(text, "POINT_DATA", "stage");
  const std::vector<double> component = vtk_array(text, "POINT_DATA", "component");
  ASSERT_EQ(stage.size(), whole.points.size());
  for (std::size_t v = 0; v < stage.size(); ++v) {
    bool is_early = false;
    for (const Vec3& p : stage1.points) is_early = is_early || p == whole.points[v];
    EXPECT_EQ(stage[v], is_early ? 1 : 2) << v;
    EXPECT_TRUE(component[v] >= 1 && component[v] <= 4);
  }
  const std::vector<double> quality = vtk_array(text, "CELL_DATA", "quality");
  const std::vector<double> angle = vtk_array(text, "CELL_DATA", "min_angle");
  const std::vector<double> h = vtk_array(text, "CELL_DATA", "h"), h_of_points = vtk_array(text, "POINT_DATA", "h");
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& [a, b, c] = whole.triangles[t];
    EXPECT_EQ(component[a], component[b]);
    EXPECT_EQ(component[a], component[c]);
    // Heron's area, and the angle at the shortest side by the law of cosines.
    const double x = distance(whole.points[a], whole.points[b]), y = distance(whole.points[b], whole.points[c]);
    const double z = distance(whole.points[c], whole.points[a]), s = (x + y + z) / 2;
    const double area = std::sqrt(std::max(0.0, s * (s - x) * (s - y) * (s - z)));
    EXPECT_NEAR(quality[t], 4 * std::numbers::sqrt3 * area / (x * x + y * y + z * z), 1e-6);
    const double least = std::min({x, y, z}),
                 cosine = (x * x + y * y + z * z - 2 * least * least) * least / (2 * x * y * z);
    EXPECT_NEAR(angle[t], std::acos(cosine) * 180 / std::numbers::pi, 1e-4);
    EXPECT_LT(h[t], 1);
    for (const std::uint32_t v : {a, b, c}) EXPECT_GE(h_of_points[v], h[t]);
  }
}

// A millimetre is a thousandth of a metre; a file without units keeps its numbers.
TEST_F(MeshFormats, GlbIsInMetresWhereTheUnitIsKnown) {
  const std::string head =
      "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nencoding: ascii\nspace dimension: 3\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\n";
  std::string samples = "\n";
  for (int i = 0; i < 27; ++i) samples += i == 13 ? "100\n" : "0\n";
  const auto low_corner = [&](const std::string& units) {
    write_file(folder_ / "g.nrrd", head + units + samples);
    EXPECT_EQ(run_deliso({"mesh", folder_ / "g.nrrd", "--isovalue", "50", "-o", folder_ / "m.glb"}).exit_code, 0);
    const std::string bytes = read_file(folder_ / "m.glb");
    const Json json = Json::parse(bytes.substr(20, bytes.find(std::string("BIN\0", 4)) - 24));
    return json["nodes"][0]["translation"][0].get<double>() + json["accessors"][0]["min"][0].get<double>();
  };
  EXPECT_NEAR(low_corner(""), 0.5, 1e-6);
  EXPECT_NEAR(low_corner("space units: \"mm\" \"mm\" \"mm\"\n"), 0.0005, 1e-9);
  EXPECT_NEAR(low_corner("space units: \"um\" \"um\" \"um\"\n"), 5e-7, 1e-12);
}

}  // namespace
}  // namespace deliso::testing
