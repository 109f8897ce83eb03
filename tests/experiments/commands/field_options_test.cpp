// Masks, labels, holes and named isovalues as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/program_runner.h"
#include "volume/io/volume_file.h"

namespace deliso::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// field(distance to the middle) at 16^3 samples.
template <class Sample, class Field>
void write_field(const std::string& path, Field field) {
  std::vector<Sample> samples;
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        samples.push_back(static_cast<Sample>(field(i, std::hypot(i - 7.5, j - 7.5, k - 7.5))));
  write_volume(ScalarGrid({16, 16, 16}, std::move(samples)), path);
}

class Fields : public ::testing::Test {
 protected:
  // Both must say so, and the report of `mesh` is returned.
  Json expect_proven(const std::vector<std::string>& of_mesh, const std::vector<std::string>& of_verify = {}) {
    std::vector<std::string> mesh = {"mesh", volume_, "-o", mesh_, "--report", folder_ / "r.json"};
    mesh.insert(mesh.end(), of_mesh.begin(), of_mesh.end());
    result_ = run_deliso(mesh);
    EXPECT_EQ(result_.exit_code, 0) << result_.err << result_.out;
    std::vector<std::string> verify = {"verify", mesh_, volume_};
    verify.insert(verify.end(), of_verify.begin(), of_verify.end());
    const ProgramResult verified = run_deliso(verify);
    EXPECT_EQ(verified.exit_code, 0) << verified.err << verified.out;
    return Json::parse(read_file(folder_ / "r.json"));
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) {
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 2) << part;
    EXPECT_TRUE(has(result.err, part)) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  Json info() {
    const ProgramResult result = run_deliso({"info", volume_, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out);
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd", mesh_ = folder_ / "m.ply";
  ProgramResult result_;
};

TEST_F(Fields, AMaskIsToldWithWhatHelps) {
  write_field<std::uint8_t>(volume_, [](int, double d) { return d < 6 ? 255 : 0; });
  const Json told = info();
  EXPECT_EQ(told["volume"]["kind"], "mask");
  EXPECT_EQ(told["suggested_isovalues"][0]["isovalue"], 127.5);
  for (const char* name : {"otsu", "mean", "median", "50%"}) EXPECT_EQ(told["named_isovalues"][name], 127.5) << name;
  EXPECT_TRUE(has(told["advice"], "--smooth"));
  const Json plain = expect_proven({"--isovalue", "3"}, {"--isovalue", "3"});
  EXPECT_TRUE(has(result_.err, "mask of 0 and 255")) << result_.err;
  EXPECT_TRUE(has(result_.err, "--smooth")) << result_.err;
  EXPECT_TRUE(has(result_.err, "127.5 (--isovalue otsu)")) << result_.err;
  // The mesh's file says how it was smoothed; without that verify would have to be told.
  const Json smooth = expect_proven({"--isovalue", "otsu", "--smooth", "1"}, {"--isovalue", "127.5"});
  EXPECT_LT(smooth["vertices"].get<int>() * 5, plain["vertices"].get<int>());
  EXPECT_EQ(smooth["isovalue"], 127.5);
  EXPECT_EQ(smooth["field"]["isovalue_name"], "otsu");
  EXPECT_EQ(smooth["parameters"]["field"]["smooth"], 1.0);
  EXPECT_EQ(smooth["certificate"]["field"], "smoothed (sigma 1 voxel)");
  EXPECT_TRUE(has(result_.out, "proven: smoothed (sigma 1 voxel)")) << result_.out;
  EXPECT_TRUE(has(result_.err, "isovalue otsu is 127.5")) << result_.err;
  EXPECT_FALSE(has(result_.err, "mask")) << result_.err;
  const ProgramResult other = run_deliso({"verify", mesh_, volume_, "--isovalue", "127.5", "--smooth", "0"});
  EXPECT_EQ(other.exit_code, 1) << "it is no mesh of the mask itself";
}

TEST_F(Fields, SmoothingIsTheSameForAllCommands) {
  write_field<std::uint8_t>(volume_, [](int, double d) { return d < 6 ? 1 : 0; });
  expect_proven({"--isovalue", "0.5", "--smooth", "1.2", "--set", "spacing=ignore"}, {"--isovalue", "0.5"});
  // A file that tells nothing needs the option; that of STL has room for it in its header.
  const std::string stl = folder_ / "m.stl", silent = folder_ / "silent.stl";
  EXPECT_EQ(run_deliso({"mesh", volume_, "--isovalue", "0.5", "--smooth", "2w", "-o", stl}).exit_code, 0);
  write_file(silent, std::string(80, ' ') + read_file(stl).substr(80));
  EXPECT_EQ(run_deliso({"verify", stl, volume_, "--isovalue", "0.5"}).exit_code, 0);
  EXPECT_EQ(run_deliso({"verify", silent, volume_, "--isovalue", "0.5", "--smooth", "2mm"}).exit_code, 0);
  EXPECT_EQ(run_deliso({"verify", silent, volume_, "--isovalue", "0.5"}).exit_code, 1);
  EXPECT_EQ(run_deliso({"topology", volume_, "--isovalue", "50%", "--smooth", "2"}).exit_code, 0);
  EXPECT_EQ(run_deliso({"info", volume_, "--smooth", "2"}).exit_code, 0);
  EXPECT_EQ(run_deliso({"render", volume_, "--label", "1", "--smooth", "2", "-o", folder_ / "p.png", "--size", "40x40"})
                .exit_code,
            0);
}

// Label 1 has two components and label 2 one. What one label has left out, and how far it is off, is not that of
// others.
TEST_F(Fields, SeveralLabelsInAFileKeepWhatIsTheirOwn) {
  write_field<std::int16_t>(volume_, [](int i, double d) { return d > 6 ? (i == 0 ? 1 : 0) : i < 8 ? 1 : 2; });
  for (const std::string labels : {"1,2", "2,1"}) {
    for (const std::string extension : {".ply", ".vtk", ".vtp", ".mesh"}) {
      SCOPED_TRACE(labels + extension);
      const std::string largest = folder_ / ("largest" + extension), few = folder_ / ("few" + extension);
      ASSERT_EQ(run_deliso({"mesh", volume_, "--label", labels, "--keep-largest", "1", "-o", largest}).exit_code, 0);
      EXPECT_EQ(run_deliso({"verify", largest, volume_}).exit_code, 0);
      EXPECT_EQ(run_deliso({"verify", largest, volume_, "--label", "1"}).exit_code, 0);
      EXPECT_EQ(run_deliso({"verify", largest, volume_, "--label", "1", "--dropped", "0"}).exit_code, 1);
      ASSERT_EQ(run_deliso({"mesh", volume_, "--label", labels, "--target-vertices", "30", "-o", few}).exit_code, 0);
      EXPECT_EQ(run_deliso({"verify", few, volume_}).exit_code, 0);
    }
  }
}

// No isovalue was given, so none is named.
TEST_F(Fields, ALabelThatSmoothingLeavesNothingOfIsNamed) {
  write_field<std::int16_t>(volume_, [](int /*i*/, double d) { return d > 6 ? 0 : d > 1 ? 2 : 7; });
  const ProgramResult result = run_deliso({"mesh", volume_, "--label", "2,7", "--smooth", "2", "-o", mesh_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(has(result.err, "label 7 has no surface left: smoothed by 2 voxels")) << result.err;
  EXPECT_FALSE(has(result.err, "isovalue")) << result.err;
}

TEST_F(Fields, LabelsComeInOneFileOrEachInItsOwn) {
  write_field<std::int16_t>(volume_, [](int i, double d) { return d > 6 ? 0 : i < 8 ? 2 : -5; });
  EXPECT_EQ(info()["volume"]["kind"], "labels");
  EXPECT_TRUE(has(info()["advice"], "--label"));
  const Json both = expect_proven({"--label", "2,-5", "--smooth", "1"});
  ASSERT_EQ(both["labels"].size(), 2u);
  EXPECT_EQ(both["labels"][1]["field"]["label"], -5);
  const TriangleMesh mesh = read_mesh(mesh_);
  EXPECT_EQ(std::set<std::int32_t>(mesh.labels.begin(), mesh.labels.end()), (std::set<std::int32_t>{-5, 2}));
  EXPECT_EQ(mesh.triangles.size(),
            both["labels"][0]["triangles"].get<std::size_t>() + both["labels"][1]["triangles"].get<std::size_t>());
  // One of them is checked alone.
  EXPECT_EQ(run_deliso({"verify", mesh_, volume_, "--label", "-5"}).exit_code, 0);
  // As numbers of the triangles, which VTK files hold in one line and Medit files at the end of each triangle.
  const std::string numbers = folder_ / "n.vtk", medit = folder_ / "n.mesh";
  for (const std::string& name : {numbers, medit}) {
    EXPECT_EQ(run_deliso({"mesh", volume_, "--label", "2,-5", "--smooth", "1", "-o", name, "--ascii"}).exit_code, 0);
    EXPECT_EQ(read_mesh(name).triangles, mesh.triangles);
  }
  // What was written is verified, all of it and one label alone; so is a file of one label, whose components Medit
  // numbers.
  for (const std::string extension : {".ply", ".vtk", ".vtp", ".mesh"}) {
    SCOPED_TRACE(extension);
    const std::string several = folder_ / ("several" + extension), one = folder_ / ("one" + extension);
    EXPECT_EQ(run_deliso({"mesh", volume_, "--label", "2,-5", "--smooth", "1", "-o", several}).exit_code, 0);
    EXPECT_EQ(read_mesh(several).labels, mesh.labels);
    EXPECT_EQ(run_deliso({"verify", several, volume_}).exit_code, 0);
    EXPECT_EQ(run_deliso({"verify", several, volume_, "--label", "2"}).exit_code, 0);
    EXPECT_EQ(run_deliso({"mesh", volume_, "--label", "2", "--smooth", "1", "-o", one}).exit_code, 0);
    EXPECT_EQ(run_deliso({"verify", one, volume_}).exit_code, 0);
  }
  // PLY, whatever its name is; not what is called PLY and is another format.
  const ProgramResult piped = run_deliso({"mesh", volume_, "--label", "2,-5", "--smooth", "1", "-o", "-"});
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, read_file(mesh_));
  expect_refused({"mesh", volume_, "--label", "2,-5", "-o", mesh_, "--format", "obj"}, "several labels in one file");
  const std::string text = read_file(numbers);
  const std::size_t at = text.find("label 1 " + std::to_string(mesh.triangles.size()) + " int\n");
  ASSERT_NE(at, std::string::npos);
  std::istringstream in(text.substr(text.find('\n', at)));
  std::istringstream of_medit(read_file(medit).substr(read_file(medit).find("Triangles\n") + 10));
  std::size_t count = 0;
  of_medit >> count;
  ASSERT_EQ(count, mesh.triangles.size());
  for (const std::int32_t label : mesh.labels) {
    std::int32_t found = 0, reference = 0, corner = 0;
    in >> found;
    of_medit >> corner >> corner >> corner >> reference;
    EXPECT_EQ(found, label);
    EXPECT_EQ(reference, label);
  }
  const std::string each = folder_ / "l_{label}.obj";
  EXPECT_EQ(
      run_deliso({"mesh", volume_, "--label", "2,-5", "-o", each, "--report", folder_ / "l_{label}.json"}).exit_code,
      0);
  for (const char* label : {"2", "-5"}) {
    const std::string name = folder_ / ("l_" + std::string(label));
    EXPECT_EQ(run_deliso({"verify", name + ".obj", volume_}).exit_code, 0) << label;
    EXPECT_EQ(Json::parse(read_file(name + ".json"))["field"]["label"], std::stoi(label));
  }
}

// A ball of radius 4 in 12^3 samples; NaN in the middle, an infinity of each sign where it changes nothing.
std::string holed_volume() {
  std::string bytes = "NRRD0004\ntype: float\ndimension: 3\nsizes: 12 12 12\nencoding: raw\nendian: little\n\n";
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        const bool middle = i == 5 && j == 5 && k == 5, corner = i + j + k == 0, inner = i == 5 && j == 5 && k == 7;
        const float sample = middle   ? kNan
                             : corner ? -kInf
                             : inner  ? kInf
                                      : static_cast<float>(4 - std::hypot(i - 5, j - 5, k - 5));
        for (const unsigned shift : {0u, 8u, 16u, 24u})
          bytes += static_cast<char>(std::bit_cast<std::uint32_t>(sample) >> shift & 255u);
      }
  return bytes;
}

TEST_F(Fields, NaNIsRefusedOrTakenAsAsked) {
  write_file(volume_, holed_volume());
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "0"}, "sample (0, 0, 0) is minus infinity");
  expect_refused({"topology", volume_, "--isovalue", "0"}, "--nan outside or --nan inside");
  const Json told = info();
  EXPECT_EQ(told["volume"]["not_finite"], (Json{{"nan", 1}, {"plus_infinite", 1}, {"minus_infinite", 1}}));
  EXPECT_LT(told["volume"]["range"][1], 4);  // of the finite ones
  // Outside it is a hole in the ball; inside it is not. Infinities lie on their own sides.
  const Json outside = expect_proven({"--isovalue", "0", "--nan", "outside"}, {"--isovalue", "0"});
  EXPECT_EQ(outside["components"], 2);
  EXPECT_TRUE(has(result_.err, "1 sample is NaN, taken as outside")) << result_.err;
  EXPECT_TRUE(has(result_.err, "2 samples are infinite")) << result_.err;
  EXPECT_EQ(outside["volume"]["sha256"], told["volume"]["sha256"]);
  EXPECT_EQ(expect_proven({"--isovalue", "0", "--nan", "inside"}, {"--isovalue", "0"})["components"], 1);
  // Below the isovalue is inside: what is outside lies above.
  EXPECT_EQ(expect_proven({"--isovalue", "0", "--nan", "outside", "--invert"}, {"--isovalue", "0"})["components"], 1);
  // Even where all finite samples lie on one side: around NaN and minus infinity.
  EXPECT_EQ(expect_proven({"--isovalue", "-100", "--nan", "outside"}, {"--isovalue", "-100"})["components"], 2);
  // Names are of the finite samples.
  EXPECT_EQ(expect_proven({"--isovalue", "otsu", "--nan", "outside"}, {"--isovalue", "otsu"})["isovalue"],
            told["named_isovalues"]["otsu"]);
}

// The names of isovalues, and what stands for NaN, follow from the samples of the region alone, for all commands.
TEST_F(Fields, OfARegionAreOfItsSamples) {
  std::string bytes = holed_volume();
  for (const std::size_t byte : {0u, 1u, 2u, 3u}) bytes[bytes.size() - 4 + byte] = "\0\0\x7a\x44"[byte];  // 1000
  write_file(volume_, bytes);
  EXPECT_EQ(info()["volume"]["range"][1], 1000);
  for (const char* name : {"otsu", "25%", "75%"}) {
    const Json report =
        expect_proven({"--isovalue", name, "--nan", "outside", "--region", ":10,:10,:10"}, {"--isovalue", name});
    EXPECT_LT(report["isovalue"], 4) << name;
  }
}

TEST_F(Fields, ClosedIsNotedInTheFileOfTheMesh) {
  write_field<float>(volume_, [](int, double d) { return d - 9; });
  const Json report = expect_proven({"--isovalue", "0", "--invert", "--set", "boundary=closed"}, {"--isovalue", "0"});
  EXPECT_EQ(report["boundary_loops"], 0);
  EXPECT_EQ(report["parameters"]["field"]["invert"], true);
  // The short form, with the same note in the file.
  const std::string closed = read_file(mesh_);
  expect_proven({"--isovalue", "0", "--invert", "--closed"}, {"--isovalue", "0"});
  EXPECT_EQ(read_file(mesh_), closed);
  // All inside: the box.
  EXPECT_EQ(expect_proven({"--isovalue", "-50", "--set", "boundary=closed"}, {"--isovalue", "-50"})["components"], 1);
}

TEST_F(Fields, AreRefusedInOneSentenceWhereTheyMakeNoSense) {
  write_field<std::uint8_t>(volume_, [](int, double d) { return d < 6 ? 1 : 0; });
  expect_refused({"mesh", volume_, "-o", mesh_}, "--isovalue is required (or --label N");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "auto"}, "otsu, mean, median or P%");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "200%"}, "found '200%'");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "0.4", "--label", "1"}, "at 0.5");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "otsu", "--label", "1"}, "found 'otsu', leave it out");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "70", "--set", "field.label=1"}, "at 0.5");
  expect_refused({"topology", volume_, "--isovalue", "50%", "--label", "1"}, "found '50%'");
  expect_refused({"mesh", volume_, "-o", mesh_, "--label", "7"}, "no sample has the label 7");
  expect_refused({"mesh", volume_, "-o", mesh_, "--label", "1,x"}, "found 'x'");
  expect_refused({"mesh", volume_, "-o", folder_ / "m.stl", "--label", "0,1"}, "{label}");
  expect_refused({"mesh", volume_, "-o", folder_ / "{label}.stl", "--isovalue", "0.5"}, "none is meshed");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "0.5", "--smooth", "-1"}, "--smooth");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "0.5", "--smooth", "5000"}, "standard deviation");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "0.5", "--nan", "zero"}, "refuse, outside or inside");
  expect_refused({"mesh", volume_, "-o", mesh_, "--isovalue", "1.5", "--set", "boundary=closed"}, "no point");
  expect_refused({"topology", volume_, "--label", "0,1"}, "one label");
}

}  // namespace
}  // namespace deliso::testing
