// What we promise of a closed mesh: hand it to TetGen or Gmsh, and it will be filled; VTK reads it as we wrote it. Each
// test is skipped where the program is not installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "delaunay/base/vec3.h"
#include "experiments/config/json.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

// The volume of tetrahedra whose corners are numbered in `point_at`; false when one is turned inside out or flat.
struct FilledVolume {
  double volume = 0;
  std::size_t tetrahedra = 0;
  std::size_t flat = 0;

  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double six_times = std::abs(dot(b - a, cross(c - a, d - a)));
    volume += six_times / 6;
    ++tetrahedra;
    if (!(six_times > 0)) ++flat;
  }
};

// TetGen's .node and .ele.
FilledVolume filled_by_tetgen(const std::string& stem) {
  std::map<std::int64_t, Vec3> point_at;
  std::ifstream nodes(stem + ".1.node"), elements(stem + ".1.ele");
  std::int64_t count = 0, dimension = 0, attributes = 0, markers = 0, number = 0;
  double ignored = 0;
  nodes >> count >> dimension >> attributes >> markers;
  for (std::int64_t i = 0; i < count; ++i) {
    Vec3 p;
    nodes >> number >> p.x >> p.y >> p.z;
    for (std::int64_t k = 0; k < attributes + markers; ++k) nodes >> ignored;
    point_at[number] = p;
  }
  FilledVolume filled;
  elements >> count >> dimension >> attributes;
  for (std::int64_t i = 0; i < count; ++i) {
    std::array<std::int64_t, 4> v{};
    elements >> number >> v[0] >> v[1] >> v[2] >> v[3];
    for (std::int64_t k = 0; k < attributes; ++k) elements >> ignored;
    filled.add(point_at[v[0]], point_at[v[1]], point_at[v[2]], point_at[v[3]]);
  }
  EXPECT_TRUE(nodes && elements) << stem;
  return filled;
}

// A Medit file with tetrahedra, as Gmsh writes it.
FilledVolume filled_by_gmsh(const std::string& path) {
  std::ifstream file(path);
  std::vector<Vec3> points;
  FilledVolume filled;
  std::size_t count = 0;
  double ignored = 0;
  for (std::string word; file >> word;) {
    if (word == "Vertices") {
      file >> count;
      points.resize(count);
      for (Vec3& p : points) file >> p.x >> p.y >> p.z >> ignored;
    } else if (word == "Tetrahedra") {
      file >> count;
      for (std::size_t i = 0; i < count; ++i) {
        std::array<std::size_t, 4> v{};
        file >> v[0] >> v[1] >> v[2] >> v[3] >> ignored;
        filled.add(points.at(v[0] - 1), points.at(v[1] - 1), points.at(v[2] - 1), points.at(v[3] - 1));
      }
    }
  }
  return filled;
}

ProgramResult run_shell(const std::string& command) { return run_program_at("/bin/sh", {"-c", command}); }

bool is_installed(const std::string& program) { return run_shell("command -v " + program).exit_code == 0; }

struct ClosedField {
  std::string name;
  std::string size;
  std::string isovalue;

  friend std::ostream& operator<<(std::ostream& out, const ClosedField& field) { return out << field.name; }
};

// Spheres, tori, nested shells, labyrinths; and a volume of the public ones where there are any.
class OtherPrograms : public ::testing::TestWithParam<ClosedField> {
 protected:
  // Writes the closed mesh as each of `extensions`, as text; false when there is no volume.
  bool write_meshes(const std::vector<std::string>& extensions) {
    const ClosedField& field = GetParam();
    volume_ = folder_ / "v.nrrd";
    if (field.size.empty()) {
      const char* const data = std::getenv("DELISO_DATA");
      if (data == nullptr) return false;
      volume_ = (fs::path(data) / (field.name + ".nrrd")).string();
    } else {
      EXPECT_EQ(run_deliso({"generate", field.name, "--size", field.size, "-o", volume_}).exit_code, 0);
    }
    for (const std::string& extension : extensions)
      write_closed(mesh(extension), {"--ascii", "--report", folder_ / "r.json"});
    report_ = read_json(folder_ / "r.json");
    return true;
  }
  // Coarser than usual: the programs take longer than we do.
  void write_closed(const std::string& path, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "mesh",  volume_,           "--isovalue", GetParam().isovalue,   "-o",    path,
        "--set", "boundary=closed", "--set",      "stage2.epsilon1=0.3", "--set", "stage2.epsilon2=0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  [[nodiscard]] std::string mesh(const std::string& extension) const {
    // Programs take the stem of a file for the name of what they write.
    return folder_ / ("m_" + extension + "." + extension);
  }
  [[nodiscard]] double enclosed() const { return report_["surface"]["enclosed_volume"].get<double>(); }
  // Formats without hole points have their cavities filled, too: then it is what the outermost component encloses,
  // which all others lie in where a built-in field has a cavity.
  [[nodiscard]] double filled_cavities() const {
    double most = 0, least = 0;
    for (const Json& component : report_["surface"]["components"]) {
      most = std::max(most, component["enclosed_volume"].get<double>());
      least = std::min(least, component["enclosed_volume"].get<double>());
    }
    return least < 0 ? most : enclosed();
  }
  TemporaryFolder folder_;
  std::string volume_;
  Json report_;
};

TEST_P(OtherPrograms, TetGenFillsTheMesh) {
  if (!is_installed("tetgen")) GTEST_SKIP() << "tetgen is not installed";
  const std::vector<std::string> extensions = {"smesh", "off", "ply", "stl", "mesh"};
  if (!write_meshes(extensions)) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  for (const std::string& extension : extensions) {
    SCOPED_TRACE(extension);
    // Its usual tolerance, 1e-8 of the box, takes fine triangles of scans for flat ones. With -Y our triangles stay
    // whole.
    const std::string flags = extension == "smesh" ? "-pYQT1e-14" : "-pQT1e-14";
    const ProgramResult result = run_program_at("/usr/bin/env", {"tetgen", flags, mesh(extension)});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    const FilledVolume filled = filled_by_tetgen(folder_ / ("m_" + extension));
    EXPECT_GT(filled.tetrahedra, 0u);
    if (GetParam().size.empty() && extension != "smesh") continue;
    const double expected = extension == "smesh" ? enclosed() : filled_cavities();
    EXPECT_NEAR(filled.volume / expected, 1, extension == "stl" ? 1e-4 : 1e-7);
  }
}

TEST_P(OtherPrograms, GmshFillsTheMesh) {
  if (!is_installed("gmsh")) GTEST_SKIP() << "gmsh is not installed";
  if (!write_meshes({"msh"})) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  const std::string commands = "cd " + folder_.path().string() +
                               " && sed -n 's/^geo //p' m_msh.msh > m.geo && gmsh -3 m.geo -v 2 -o filled.mesh";
  const ProgramResult result = run_shell(commands);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const FilledVolume filled = filled_by_gmsh(folder_ / "filled.mesh");
  EXPECT_GT(filled.tetrahedra, 0u);
  EXPECT_NEAR(filled.volume / enclosed(), 1, 1e-7);
}

// Every format that Gmsh reads, and its own two versions, has all the triangles.
TEST_P(OtherPrograms, GmshReadsEveryFormatThatItKnows) {
  if (!is_installed("gmsh")) GTEST_SKIP() << "gmsh is not installed";
  const std::vector<std::string> extensions = {"msh", "mesh", "stl", "vtk", "ply"};
  if (!write_meshes(extensions)) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  write_closed(folder_ / "m_old.msh", {"--msh-version", "2.2"});
  std::vector<std::string> files = {folder_ / "m_old.msh"};
  for (const std::string& extension : extensions) files.push_back(mesh(extension));
  const std::string expected = "Triangles\n " + std::to_string(report_["triangles"].get<std::int64_t>()) + "\n";
  for (const std::string& file : files) {
    const std::string out = folder_ / "read.mesh";
    const ProgramResult result =
        run_program_at("/usr/bin/env", {"gmsh", file, "-save", "-o", out, "-format", "mesh", "-v", "2"});
    EXPECT_EQ(result.exit_code, 0) << file << result.out << result.err;
    EXPECT_EQ(result.out.find("Error"), std::string::npos) << file << result.out;
    EXPECT_NE(read_file(out).find(expected), std::string::npos) << file;
  }
}

constexpr const char* kVtkScript = R"(
import sys, vtk
readers = {'ply': vtk.vtkPLYReader, 'obj': vtk.vtkOBJReader, 'stl': vtk.vtkSTLReader, 'vtk': vtk.vtkPolyDataReader,
           'vtp': vtk.vtkXMLPolyDataReader, 'glb': vtk.vtkGLTFReader}
for path in sys.argv[1:]:
    extension = path.rsplit('.', 1)[1]
    reader = readers[extension]()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    if extension == 'glb':
        parts = vtk.vtkCompositeDataGeometryFilter()
        parts.SetInputConnection(reader.GetOutputPort())
        parts.Update()
        data = parts.GetOutput()
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(data)
    edges.FeatureEdgesOff()
    edges.BoundaryEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.ManifoldEdgesOff()
    edges.Update()
    mass = vtk.vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    of_points, of_cells = data.GetPointData(), data.GetCellData()
    names = [of_points.GetArrayName(i) for i in range(of_points.GetNumberOfArrays())]
    names += [of_cells.GetArrayName(i) for i in range(of_cells.GetNumberOfArrays())]
    comments = data.GetFieldData().GetAbstractArray('comments')
    print(extension, data.GetNumberOfPoints(), data.GetNumberOfPolys(), edges.GetOutput().GetNumberOfCells(),
          repr(mass.GetVolume()), comments.GetValue(1).replace(' ', '=') if comments else '-', ','.join(names))
)";

TEST_P(OtherPrograms, VtkReadsEveryFormatThatItKnows) {
  if (run_shell("/usr/bin/python3 -c 'import vtk'").exit_code != 0) GTEST_SKIP() << "python3-vtk9 is not installed";
  const std::vector<std::string> extensions = {"ply", "obj", "stl", "vtk", "vtp", "glb"};
  if (!write_meshes(extensions)) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  write_file(folder_ / "read.py", kVtkScript);
  std::vector<std::string> arguments = {folder_ / "read.py"};
  for (const std::string& extension : extensions) arguments.push_back(mesh(extension));
  // The same as binary data.
  for (const std::string extension : {"ply", "stl", "vtk", "vtp"}) {
    const std::string path = folder_ / ("binary." + extension);
    write_closed(path, {});
    arguments.push_back(path);
  }
  const ProgramResult result = run_program_at("/usr/bin/python3", arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::size_t read = 0;
  for (std::string line; std::getline(lines, line); ++read) {
    SCOPED_TRACE(line);
    std::istringstream words(line);
    std::string extension, comment, names;
    std::int64_t points = 0, polygons = 0, bad_edges = -1;
    double volume = 0;
    words >> extension >> points >> polygons >> bad_edges >> volume >> comment >> names;
    EXPECT_EQ(points, report_["vertices"].get<std::int64_t>());
    EXPECT_EQ(polygons, report_["triangles"].get<std::int64_t>());
    EXPECT_EQ(bad_edges, 0);
    EXPECT_NEAR(volume / enclosed(), 1, 1e-4);
    if (extension != "vtk" && extension != "vtp") continue;
    EXPECT_EQ(comment, "promise.max_distance=1");
    EXPECT_EQ(names, "component,stage,h,gradient,h,quality,min_angle");
  }
  EXPECT_EQ(read, 10u);
}

INSTANTIATE_TEST_SUITE_P(Fields, OtherPrograms,
                         ::testing::Values(ClosedField{"sphere", "16", "0.3"}, ClosedField{"torus", "16", "0.7"},
                                           ClosedField{"shells", "24", "100.5"}, ClosedField{"gyroid", "12", "0.1"},
                                           ClosedField{"double_torus", "16", "500.5"}, ClosedField{"fuel", "", "70.1"}),
                         [](const auto& field) { return field.param.name; });

}  // namespace
}  // namespace deliso::testing
