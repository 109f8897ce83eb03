// Volumes that lie askew in the world: one volume in five formats, spaces, local origins, lengths, shear.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/triangle_mesh.h"
#include "tests/support/program_runner.h"
#include "volume/affine.h"

namespace deliso::testing {
namespace {

constexpr std::int32_t kNx = 12, kNy = 11, kNz = 9;
constexpr const char* kIsovalue = "40";

// Rotated, reflected, unequal spacings (1.25, 2.5, 1.5); all numbers are floats. In LPS.
const Affine kAskew{{Vec3{0.75, 1, 0}, Vec3{-2, 1.5, 0}, Vec3{0, 0, -1.5}}, {-20.5, 33.25, 7}};

// A ball, off the middle, brighter inside.
std::vector<float> ball() {
  std::vector<float> samples;
  for (int k = 0; k < kNz; ++k)
    for (int j = 0; j < kNy; ++j)
      for (int i = 0; i < kNx; ++i)
        samples.push_back(static_cast<float>(100 - 22 * std::hypot(i - 5.3, 1.1 * j - 5.6, 1.2 * k - 4.7)));
  return samples;
}

template <class Number>
void put(std::string& bytes, std::size_t place, Number value) {
  std::memcpy(bytes.data() + place, &value, sizeof value);
}

std::string sample_text() {
  const std::vector<float> samples = ball();
  std::string bytes(samples.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

std::string numbers_text(const Vec3& v, const char* between) {
  return Json(v.x).dump() + between + Json(v.y).dump() + between + Json(v.z).dump();
}

std::string nrrd_file(const Affine& map, const std::string& space = "space: left-posterior-superior\n") {
  std::string text = "NRRD0005\ntype: float\ndimension: 3\nsizes: 12 11 9\nencoding: raw\nendian: little\n" + space;
  if (space.empty()) text += "space dimension: 3\n";
  text += "space units: \"mm\" \"mm\" \"mm\"\nspace directions:";
  for (const Vec3& column : map.columns) text += " (" + numbers_text(column, ",") + ")";
  return text + "\nspace origin: (" + numbers_text(map.offset, ",") + ")\n\n" + sample_text();
}

// The world of NIfTI is RAS.
template <class Real, class Size>
std::string nifti_file(const Affine& lps, std::size_t header, std::size_t rows) {
  std::string bytes(header + 4, '\0');
  const bool is_first = sizeof(Size) == 2;
  put(bytes, 0, static_cast<std::int32_t>(header));
  const std::array<std::int64_t, 4> dims{3, kNx, kNy, kNz};
  for (std::size_t n = 0; n < 4; ++n) put(bytes, (is_first ? 40 : 16) + n * sizeof(Size), static_cast<Size>(dims[n]));
  put(bytes, is_first ? 70 : 12, std::int16_t{16});
  if (is_first) {
    put(bytes, 108, static_cast<float>(header + 4));
    put(bytes, 123, std::int8_t{2});
    put(bytes, 254, std::int16_t{1});
    std::memcpy(bytes.data() + 344, "n+1", 3);
  } else {
    put(bytes, 168, static_cast<std::int64_t>(header + 4));
    put(bytes, 500, std::int32_t{2});
    put(bytes, 348, std::int32_t{1});
    std::memcpy(bytes.data() + 4, "n+2", 3);
  }
  for (std::size_t row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3& v = n < 3 ? lps.columns.at(n) : lps.offset;
      put(bytes, rows + (4 * row + n) * sizeof(Real), static_cast<Real>(sign * v[row]));
    }
  }
  return bytes + sample_text();
}

std::string metaimage_file(const Affine& map) {
  std::string matrix, spacing;
  for (const Vec3& column : map.columns) {
    matrix += numbers_text(column / norm(column), " ") + " ";
    spacing += Json(norm(column)).dump() + " ";
  }
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = " +
         matrix + "\nOffset = " + numbers_text(map.offset, " ") + "\nElementSpacing = " + spacing +
         "\nDimSize = 12 11 9\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n" + sample_text();
}

std::string vti_file(const Affine& map) {
  std::string direction, spacing;
  for (std::size_t row = 0; row < 3; ++row)
    for (const Vec3& column : map.columns) direction += Json(column[row] / norm(column)).dump() + " ";
  for (const Vec3& column : map.columns) spacing += Json(norm(column)).dump() + " ";
  std::string size(4, '\0');
  put(size, 0, static_cast<std::uint32_t>(sample_text().size()));
  return "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 11 0 10 0 8\" Origin=\"" +
         numbers_text(map.offset, " ") + "\" Spacing=\"" + spacing + "\" Direction=\"" + direction +
         "\"><Piece Extent=\"0 11 0 10 0 8\"><PointData Scalars=\"s\"><DataArray type=\"Float32\" Name=\"s\" "
         "format=\"appended\" offset=\"0\"/></PointData></Piece></ImageData><AppendedData encoding=\"raw\">_" +
         size + sample_text() + "</AppendedData></VTKFile>";
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) volume += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  return volume;
}

class WorldTest : public ::testing::Test {
 protected:
  // The mesh of a volume's file, proven by `mesh` and by `verify`.
  TriangleMesh mesh(const std::string& volume, const std::string& output, std::vector<std::string> more = {},
                    bool verified = true) {
    std::vector<std::string> arguments{"mesh", folder_ / volume, "--isovalue", kIsovalue, "-o", folder_ / output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult made = run_deliso(arguments);
    EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
    remarks_ = made.err;
    arguments = {"verify", folder_ / output, folder_ / volume, "--isovalue", kIsovalue};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto report = std::find(arguments.begin(), arguments.end(), "--report");
    if (report != arguments.end()) arguments.erase(report, report + 2);
    if (verified) {
      const ProgramResult judged = run_deliso(arguments);
      EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
    }
    return read_mesh(folder_ / output);
  }
  static double farthest(const TriangleMesh& a, const TriangleMesh& b) {
    EXPECT_EQ(a.points.size(), b.points.size());
    double far = 0;
    for (std::size_t v = 0; v < std::min(a.points.size(), b.points.size()); ++v)
      far = std::max(far, distance(a.points[v], b.points[v]));
    return far;
  }

  TemporaryFolder folder_;
  std::string remarks_;
};

TEST_F(WorldTest, OneVolumeInFiveFormatsHasItsVerticesInOnePlace) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  write_file(folder_ / "b.nii", nifti_file<float, std::int16_t>(kAskew, 348, 280));
  write_file(folder_ / "c.nii", nifti_file<double, std::int64_t>(kAskew, 540, 400));
  write_file(folder_ / "d.mha", metaimage_file(kAskew));
  write_file(folder_ / "e.vti", vti_file(kAskew));
  const TriangleMesh first = mesh("a.nrrd", "a.ply", {"--space", "LPS"});
  EXPECT_GT(signed_volume(first), 0) << "the inside is brighter: triangles face outward";
  for (const std::string name : {"b.nii", "c.nii", "d.mha"})
    EXPECT_LT(farthest(mesh(name, "m.ply", {"--space", "LPS"}), first), 1e-9) << name;
  EXPECT_LT(farthest(mesh("e.vti", "m.ply"), first), 1e-9);
  // In RAS x and y change their signs.
  TriangleMesh ras = mesh("b.nii", "m.ply");
  EXPECT_GT(signed_volume(ras), 0);
  for (Vec3& p : ras.points) p = {-p.x, -p.y, p.z};
  EXPECT_LT(farthest(ras, first), 1e-9);
}

TEST_F(WorldTest, VerticesAreTheMapOfThoseWithoutIt) {
  // The same samples with the lengths of the directions for spacing: the mesh before the map.
  const Affine straight{{Vec3{1.25, 0, 0}, Vec3{0, 2.5, 0}, Vec3{0, 0, 1.5}}, {}};
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  write_file(folder_ / "s.nrrd", nrrd_file(straight));
  TriangleMesh plain = mesh("s.nrrd", "s.ply");
  for (Vec3& p : plain.points) p = kAskew({p.x / 1.25, p.y / 2.5, p.z / 1.5});
  EXPECT_LT(farthest(mesh("a.nrrd", "a.ply"), plain), 1e-9);
}

TEST_F(WorldTest, ShearIsSaidAndAppliedAfterwards) {
  const Affine sheared{{Vec3{1, 0, 0}, Vec3{0.5, 1, 0}, Vec3{0, 0.25, 2}}, {1, 2, 3}};
  write_file(folder_ / "a.nrrd", nrrd_file(sheared));
  const TriangleMesh made = mesh("a.nrrd", "a.ply", {"--report", folder_ / "r.json"});
  EXPECT_NE(remarks_.find("not perpendicular"), std::string::npos) << remarks_;
  EXPECT_EQ(Json::parse(read_file(folder_ / "r.json"))["world"]["lengths"], "before the shear");
  EXPECT_GT(signed_volume(made), 0);
  // Every vertex lies on the isosurface of the interpolant, at the place of the map.
  const Affine to_index = sheared.inverse();
  for (const Vec3& p : made.points) {
    const Vec3 i = to_index(p);
    EXPECT_GT(i.x, -1e-9);
    EXPECT_LT(i.x, kNx - 1 + 1e-9);
  }
}

TEST_F(WorldTest, FarFromTheOriginALocalOneKeepsStl) {
  Affine far = kAskew;
  far.offset = {1e6, -2e6, 3e6};
  write_file(folder_ / "a.nrrd", nrrd_file(far));
  EXPECT_EQ(run_deliso({"mesh", folder_ / "a.nrrd", "--isovalue", kIsovalue, "-o", folder_ / "a.stl"}).exit_code, 1);
  TriangleMesh local = mesh("a.nrrd", "l.ply", {"--local-origin", "--report", folder_ / "r.json"});
  EXPECT_EQ(Json::parse(read_file(folder_ / "r.json"))["world"]["local_origin"], Json::array({1e6, -2e6, 3e6}));
  EXPECT_NE(read_file(folder_ / "l.ply").find("comment local origin 1e+06 -2e+06 3e+06"), std::string::npos);
  for (Vec3& p : local.points) p = p + far.offset;
  EXPECT_LT(farthest(local, mesh("a.nrrd", "w.ply")), 1e-8);
  mesh("a.nrrd", "l.stl", {"--local-origin"});
}

TEST_F(WorldTest, MeshesSayWhereTheyComeFrom) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  for (const std::string name : {"m.ply", "m.off", "m.obj"}) {
    mesh("a.nrrd", name, {}, false);
    const std::string text = read_file(folder_ / name);
    for (const char* const part :
         {"DelIso 0.2.0, isovalue 40", "space left-posterior-superior, units mm", "volume a.nrrd", "samples sha256 "})
      EXPECT_NE(text.find(part), std::string::npos) << name << part;
  }
  // TetGen takes the second line of an OFF file for its counts.
  const std::string off = read_file(folder_ / "m.off");
  EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(off[off.find('\n') + 1])));
  mesh("a.nrrd", "m.stl", {"--ascii"}, false);
  const std::string text = read_file(folder_ / "m.stl");
  EXPECT_NE(text.substr(0, text.find('\n')).find("space left-posterior-superior"), std::string::npos);
  mesh("a.nrrd", "b.stl", {}, false);
  // Whole notes, as far as there is room; what a verification needs comes first.
  EXPECT_TRUE(read_file(folder_ / "b.stl")
                  .starts_with("DelIso LPS; isovalue 40; version 0.2.0; volume a.nrrd                           "));
  mesh("a.nrrd", "c.stl", {"--closed"}, false);
  EXPECT_TRUE(
      read_file(folder_ / "c.stl").starts_with("DelIso LPS closed; isovalue 40; version 0.2.0; volume a.nrrd "));
}

// Space and local origin of a mesh need not be said again; what is said again counts.
TEST_F(WorldTest, TheVerificationTakesSpaceAndLocalOriginFromTheMesh) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  for (const std::string name : {"m.ply", "m.off", "m.vtp", "m.stl"}) {
    mesh("a.nrrd", name, {"--space", "RAS", "--local-origin"}, false);
    const auto verify = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {"verify",  folder_ / name, folder_ / "a.nrrd", "--isovalue",
                                            kIsovalue, "--report",     folder_ / "v.json"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run_deliso(arguments).exit_code;
    };
    EXPECT_EQ(verify({}), 0) << name;
    EXPECT_EQ(Json::parse(read_file(folder_ / "v.json"))["world"]["space"], "right-anterior-superior") << name;
    EXPECT_EQ(verify({"--space", "native"}), 1) << name;
  }
  // The same samples where no space is known.
  mesh("a.nrrd", "n.ply", {}, false);
  write_file(folder_ / "n.nrrd", nrrd_file(kAskew, ""));
  EXPECT_EQ(run_deliso({"verify", folder_ / "n.ply", folder_ / "n.nrrd", "--isovalue", kIsovalue}).exit_code, 0);
}

// Local coordinates count from the first sample of the whole volume, also where a region is meshed.
TEST_F(WorldTest, TheLocalOriginIsThatOfTheWholeVolume) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  for (const std::string name : {"m.ply", "m.vtp", "m.stl"}) {
    mesh("a.nrrd", name, {"--region", "1:9,2:8,1:7", "--local-origin"}, false);
    const ProgramResult verified = run_deliso({"verify", folder_ / name, folder_ / "a.nrrd", "--isovalue", kIsovalue});
    EXPECT_EQ(verified.exit_code, 0) << name << verified.out << verified.err;
  }
}

TEST_F(WorldTest, LengthsMayBeOfTheWorld) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));  // the smallest spacing is 1.25 mm
  for (const auto& [typed, voxels] :
       {std::pair<std::string, double>{"0.5", 0.5}, {"0.5mm", 0.4}, {"0.5w", 0.4}, {"2.5mm", 2}}) {
    mesh("a.nrrd", "m.ply", {"--set", "promise.max_distance=" + typed, "--report", folder_ / "r.json"}, false);
    EXPECT_DOUBLE_EQ(Json::parse(read_file(folder_ / "r.json"))["parameters"]["promise"]["max_distance"].get<double>(),
                     voxels);
    const ProgramResult judged = run_deliso({"verify", folder_ / "m.ply", folder_ / "a.nrrd", "--isovalue", kIsovalue,
                                             "--max-distance", typed, "--report", folder_ / "v.json"});
    EXPECT_EQ(judged.exit_code, 0) << judged.out;
    EXPECT_DOUBLE_EQ(Json::parse(read_file(folder_ / "v.json"))["promise"]["max_distance"].get<double>(), voxels);
  }
  EXPECT_EQ(run_deliso({"mesh", folder_ / "a.nrrd", "--isovalue", "40", "-o", folder_ / "x.ply", "--set",
                        "promise.max_distance=1cm"})
                .exit_code,
            2);
}

// What a mesh file promises is what it is judged by, unless another bound is given.
TEST_F(WorldTest, TheVerificationTakesItsBoundFromTheMesh) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew));
  const auto bound = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"verify",  folder_ / name, folder_ / "a.nrrd", "--isovalue",
                                          kIsovalue, "--report",     folder_ / "v.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_deliso(arguments).exit_code, 0) << name;
    return Json::parse(read_file(folder_ / "v.json"))["promise"]["max_distance"].get<double>();
  };
  for (const std::string name : {"m.ply", "m.off", "m.obj"}) {
    mesh("a.nrrd", name, {"--set", "promise.max_distance=1.75"}, false);
    EXPECT_EQ(bound(name, {}), 1.75) << name;
    EXPECT_EQ(bound(name, {"--max-distance", "1.5"}), 1.5) << name;
  }
  write_file(folder_ / "n.off", "OFF # promise.max_distance -3\n" + read_file(folder_ / "m.off").substr(4));
  EXPECT_EQ(bound("n.off", {}), 1.75);
}

TEST_F(WorldTest, VolumesAsScannersWriteThemAreProvenInTheirPlace) {
  // Axes permuted and flipped, rotated by 0.1, one axis reversed, directions with noise of 1e-17 and of 1e-9.
  for (const std::string name : {"mrhead", "oblique", "one_neg", "noise17", "tinytilt"}) {
    SCOPED_TRACE(name);
    const std::string path = std::string(DELISO_SOURCE_DIR) + "/tests/regression/direction_" + name + ".nrrd";
    write_file(folder_ / "v.nrrd", read_file(path));
    const ProgramResult made = run_deliso(
        {"mesh", folder_ / "v.nrrd", "--isovalue", "50", "-o", folder_ / "m.ply", "--report", folder_ / "r"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(run_deliso({"verify", folder_ / "m.ply", folder_ / "v.nrrd", "--isovalue", "50"}).exit_code, 0);
    EXPECT_GT(signed_volume(read_mesh(folder_ / "m.ply")), 0);
  }
}

TEST_F(WorldTest, SpacesThatAreNotKnownAreRefused) {
  write_file(folder_ / "a.nrrd", nrrd_file(kAskew, ""));
  for (const std::string space : {"LPS", "RAS", "MNI"}) {
    const ProgramResult result =
        run_deliso({"mesh", folder_ / "a.nrrd", "--isovalue", kIsovalue, "-o", folder_ / "a.ply", "--space", space});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("--space"), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.nrrd"});
}

TEST_F(WorldTest, InfoSaysWhatTheFileSays) {
  write_file(folder_ / "a.nii", nifti_file<float, std::int16_t>(kAskew, 348, 280));
  const ProgramResult result = run_deliso({"info", folder_ / "a.nii", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json volume = Json::parse(result.out)["volume"];
  EXPECT_EQ(volume["format"], "NIfTI-1");
  EXPECT_EQ(volume["stored_type"], "f32");
  EXPECT_EQ(volume["space"], "right-anterior-superior");
  EXPECT_EQ(volume["units"], "mm");
  EXPECT_EQ(volume["channels"], 1);
  EXPECT_EQ(volume["index_to_world"][0], Json::array({-0.75, 2.0, 0.0, 20.5}));
  const ProgramResult table = run_deliso({"info", folder_ / "a.nii"});
  for (const char* const part : {"format", "NIfTI-1", "stored type", "channels", "index to world", "-0.75 2 0 20.5"})
    EXPECT_NE(table.out.find(part), std::string::npos) << part << table.out;
}

}  // namespace
}  // namespace deliso::testing
