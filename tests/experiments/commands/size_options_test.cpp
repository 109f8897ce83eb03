// Sizes, components and regions on the command line: what is asked for is kept, told, and known to `verify`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

class SizeOptionsTest : public ::testing::Test {
 protected:
  // Two balls, of radius 5 and 2, of samples 2 mm apart.
  SizeOptionsTest() {
    std::string bytes =
        "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 24 14 14\nencoding: raw\nspace dimension: 3\n"
        "space units: \"mm\" \"mm\" \"mm\"\nspace directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (-3,7,100)\n\n";
    for (int k = 0; k < 14; ++k) {
      for (int j = 0; j < 14; ++j) {
        for (int i = 0; i < 24; ++i) {
          const double large = 5 - std::hypot(i - 6.3, j - 6.6, k - 6.4), small = 2 - std::hypot(i - 18, j - 6, k - 7);
          bytes += static_cast<char>(std::lround(std::fmax(0, std::fmin(250, 100 + 20 * std::fmax(large, small)))));
        }
      }
    }
    write_file(volume(), bytes);
  }

  [[nodiscard]] std::string volume() const { return folder_ / "a.nrrd"; }
  ProgramResult mesh(const std::vector<std::string>& more, const std::string& name = "m.ply") {
    std::vector<std::string> arguments = {"mesh", volume(),       "--isovalue", "99.5",
                                          "-o",   folder_ / name, "--report",   folder_ / "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  ProgramResult verify(const std::vector<std::string>& more = {}, const std::string& name = "m.ply") {
    std::vector<std::string> arguments = {"verify", folder_ / name, volume(),          "--isovalue",
                                          "99.5",   "--report",     folder_ / "v.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  Json json(const std::string& name) { return Json::parse(read_file(folder_ / name)); }

  TemporaryFolder folder_;
};

TEST_F(SizeOptionsTest, AnErrorIsPromisedAndKept) {
  for (const auto& [typed, voxels] : {std::pair<std::string, double>{"0.2", 0.2}, {"0.5mm", 0.25}, {"0.4w", 0.2}}) {
    const ProgramResult made = mesh({"--max-error", typed});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(verify().exit_code, 0);
    EXPECT_DOUBLE_EQ(json("v.json")["promise"]["max_distance"].get<double>(), voxels);
    EXPECT_DOUBLE_EQ(json("r.json")["parameters"]["size"]["max_error"].get<double>(), voxels);
  }
}

// Spacings of 2 units, whatever these are.
TEST_F(SizeOptionsTest, MillimetresFollowTheUnitsThatTheFileNames) {
  const std::string written = read_file(volume()), millimetres = "space units: \"mm\" \"mm\" \"mm\"\n";
  const auto mesh_in = [&](const std::string& units, std::vector<std::string> more) {
    std::string bytes = written;
    const std::string line = units.empty() ? "" : "space units: " + units + "\n";
    write_file(volume(), bytes.replace(bytes.find(millimetres), millimetres.size(), line));
    return mesh(more);
  };
  for (const auto& [units, typed] :
       {std::pair<std::string, std::string>{"\"micron\" \"micron\" \"micron\"", "0.0005mm"},
        {"\"\u00b5m\" \"\u00b5m\" \"\u00b5m\"", "0.0005mm"},
        {"\"inch\" \"inch\" \"inch\"", "12.7mm"},
        {"\"km\" \"km\" \"km\"", "500000mm"}}) {
    const ProgramResult made = mesh_in(units, {"--max-error", typed});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NEAR(json("r.json")["parameters"]["size"]["max_error"].get<double>(), 0.25, 1e-12) << units;
  }
  for (const std::string units : {"\"parsec\" \"parsec\" \"parsec\"", "\"mm\" \"mm\" \"um\""}) {
    for (const auto& [option, typed] : {std::pair<std::string, std::string>{"--max-error", "0.5mm"},
                                        {"--smooth", "0.5mm"},
                                        {"--min-component", "area:2mm2"},
                                        {"--set", "stage2.max_distance=0.5mm"}}) {
      const ProgramResult refused = mesh_in(units, {option, typed});
      EXPECT_EQ(refused.exit_code, 2) << units << ' ' << option;
      EXPECT_NE(refused.err.find("the volume's are"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(mesh_in(units, {"--max-error", "0.5w"}).exit_code, 0);
  }
  const std::string remark = "names no units";
  for (const std::string typed : {"0.5mm", "0.5w"}) {
    const ProgramResult made = mesh_in("", {"--max-error", typed});
    EXPECT_EQ(made.err.find(remark) != std::string::npos, typed == "0.5mm") << made.err;
    EXPECT_EQ(json("r.json")["parameters"]["size"]["max_error"], 0.25);
  }
  EXPECT_EQ(mesh_in("", {"--max-error", "0.5mm", "--quiet"}).err.find(remark), std::string::npos);
  EXPECT_EQ(mesh_in("\"mm\" \"mm\" \"mm\"", {"--max-error", "0.5mm"}).err.find(remark), std::string::npos);
  const ProgramResult told = run_deliso({"topology", volume(), "--isovalue", "99.5", "--smooth", "0.5mm"});
  EXPECT_EQ(told.err.find(remark), std::string::npos) << told.err;
}

TEST_F(SizeOptionsTest, ANumberOfVerticesIsReachedOrToldOf) {
  EXPECT_EQ(mesh({"--target-vertices", "300"}).exit_code, 0);
  EXPECT_EQ(json("r.json")["vertices"], 300);
  EXPECT_EQ(verify().exit_code, 0);
  const ProgramResult few = mesh({"--target-vertices", "8", "--max-error", "0.3"});
  EXPECT_EQ(few.exit_code, 0);
  EXPECT_NE(few.err.find("vertices were reached, not 8"), std::string::npos) << few.err;
  EXPECT_NE(json("r.json")["unmet"].dump().find("vertices were reached, not 8"), std::string::npos);
  EXPECT_EQ(verify().exit_code, 0);
}

// Insertions that would spoil the topology of noise are refused: the report says so, for scripts.
TEST_F(SizeOptionsTest, AnEdgeThatIsLongerThanAskedForIsUnmet) {
  const std::string noise = folder_ / "noise.nrrd", report = folder_ / "noise.json";
  ASSERT_EQ(run_deliso({"generate", "noise", "--size", "8", "-o", noise}).exit_code, 0);
  const auto made = [&](const std::string& edge) {
    return run_deliso(
        {"mesh", noise, "--isovalue", "127.5", "--max-edge", edge, "-o", folder_ / "noise.ply", "--report", report});
  };
  const ProgramResult fine = made("0.2");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_NE(fine.err.find("size.max_edge: the longest edge has "), std::string::npos) << fine.err;
  ASSERT_EQ(json("noise.json")["unmet"].size(), 1u);
  EXPECT_NE(fine.err.find(json("noise.json")["unmet"][0].get<std::string>()), std::string::npos) << fine.err;
  made("50");
  EXPECT_TRUE(json("noise.json")["unmet"].empty());
}

TEST_F(SizeOptionsTest, AnglesAndRatiosThatAreMissedAreUnmet) {
  for (const auto& [option, value, key] :
       {std::tuple{"--min-angle", "35", "size.min_angle: "}, std::tuple{"--max-aspect", "3", "size.max_aspect: "}}) {
    const ProgramResult result = mesh({option, value, "--set", "shape.rounds=0"});
    ASSERT_EQ(json("r.json")["unmet"].size(), 1u) << option;
    const std::string said = json("r.json")["unmet"][0];
    EXPECT_EQ(said.find(key), 0u) << said;
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
  }
  mesh({"--min-angle", "1", "--max-aspect", "40"});
  EXPECT_TRUE(json("r.json")["unmet"].empty());
}

TEST_F(SizeOptionsTest, WhatIsLeftOutIsToldAndKnownToVerify) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--keep-largest", "1"},
                                                  {"--min-component", "area:100"},
                                                  {"--min-component", "volume:500mm3"},
                                                  {"--min-component", "area:400mm2"}}) {
    const ProgramResult made = mesh(options);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.err.find("left out: 1 component "), std::string::npos) << made.err;
    EXPECT_EQ(json("r.json")["dropped"].size(), 1u);
    EXPECT_EQ(json("r.json")["components"], 1);
    // Any file may say so, so it is part of the verdict.
    const ProgramResult verified = verify();
    EXPECT_EQ(verified.exit_code, 0);
    EXPECT_NE(verified.out.find("at most 1 voxel; 1 component left out, as the mesh file says)"), std::string::npos)
        << verified.out;
    EXPECT_EQ(verify({"--dropped", "0"}).exit_code, 1);
  }
  mesh({"--max-error", "0.25"});
  EXPECT_NE(verify().out.find(
                "(distances both ways, where they are measured, are at most 0.25 voxels, as the mesh file says)"),
            std::string::npos);
  EXPECT_EQ(mesh({"--keep-largest", "1"}, "m.off").exit_code, 0);
  EXPECT_EQ(verify({}, "m.off").exit_code, 0);
  EXPECT_EQ(mesh({"--keep-largest", "1"}, "m.stl").exit_code, 0);
  EXPECT_EQ(verify({}, "m.stl").exit_code, 0);
}

// Slices three times as thick as voxels are wide: in this spacing the mesh is farther off than it promises.
TEST_F(SizeOptionsTest, ASpacingThatWasIgnoredIsKnownToVerifyInEveryFormat) {
  std::string flat = read_file(volume());
  flat.replace(flat.find("(0,0,2)"), 7, "(0,0,6)");
  write_file(volume(), flat);
  write_file(folder_ / "c.json", R"({"spacing": "ignore", "size": {"max_error": 0.3}})");
  const std::vector<std::vector<std::string>> runs = {{"m.ply"},  {"m.off"}, {"m.obj"}, {"m.stl"},
                                                      {"m.mesh"}, {"m.vtk"}, {"m.vtp"}, {"m.stl", "--ascii"}};
  for (const std::vector<std::string>& run : runs) {
    SCOPED_TRACE(run.back());
    std::vector<std::string> options = {"--config", folder_ / "c.json"};
    options.insert(options.end(), run.begin() + 1, run.end());
    ASSERT_EQ(mesh(options, run.front()).exit_code, 0);
    const ProgramResult verified = verify({}, run.front());
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
    EXPECT_EQ(json("v.json")["spacing"], "ignore");
  }
  // A file that says nothing is judged in the spacing of its volume.
  const std::string letters(80, ' ');
  ASSERT_EQ(mesh({"--set", "spacing=ignore", "--max-error", "0.3"}, "m.stl").exit_code, 0);
  write_file(folder_ / "silent.stl", letters + read_file(folder_ / "m.stl").substr(letters.size()));
  EXPECT_EQ(verify({"--max-distance", "0.3"}, "silent.stl").exit_code, 1);
  EXPECT_EQ(verify({"--max-distance", "0.3", "--ignore-spacing"}, "silent.stl").exit_code, 0);
}

// Cubes of several sizes have vertices on an edge of the box that cubes beside them do not have.
TEST_F(SizeOptionsTest, StripsAlongTheWallsLeaveNoTrianglesWithoutArea) {
  const std::string volume = std::string(DELISO_SOURCE_DIR) + "/tests/regression/flat_on_walls.nrrd";
  const ProgramResult made =
      run_deliso({"mesh", volume, "--isovalue", "1", "--closed", "--max-error", "0.1", "-o", folder_ / "w.ply"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(run_deliso({"verify", folder_ / "w.ply", volume, "--isovalue", "1"}).exit_code, 0);
}

// Without repair a component may be in several pieces: the file tells of components, which verify counts.
TEST_F(SizeOptionsTest, PiecesLeftOutAreToldAsTheComponentsThatTheyLieOn) {
  const std::string volume = std::string(DELISO_SOURCE_DIR) + "/tests/regression/dropped_pieces.nrrd";
  const ProgramResult made =
      run_deliso({"mesh", volume, "--isovalue=-0.05", "--set", "repair.max_rounds=0", "--keep-largest", "1", "-o",
                  folder_ / "p.off", "--report", folder_ / "p.json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_GT(json("p.json")["dropped"].size(), 36u);
  const ProgramResult verified = run_deliso({"verify", folder_ / "p.off", volume, "--isovalue=-0.05"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

// Edges two voxels long but for rounding: in the file, sheared, they were a hair longer, and verify looked at other
// points of their triangles than the mesher had.
TEST_F(SizeOptionsTest, EdgesOfWholeVoxelsAreSampledAtTheSamePlacesByBoth) {
  const std::string volume = std::string(DELISO_SOURCE_DIR) + "/tests/regression/whole_edges.nrrd";
  const ProgramResult made = run_deliso(
      {"mesh", volume, "--label", "2", "--set", "boundary=closed", "--max-error", "0.1", "-o", folder_ / "w.ply"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult verified = run_deliso({"verify", folder_ / "w.ply", volume, "--label", "2", "--closed"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

TEST_F(SizeOptionsTest, SmallAnglesAreToldWhereNoStageImprovesThem) {
  ASSERT_EQ(run_deliso({"generate", "noise", "--size", "12", "-o", folder_ / "n.nrrd"}).exit_code, 0);
  const std::vector<std::string> command = {"mesh", folder_ / "n.nrrd", "--isovalue", "100", "-o", folder_ / "n.ply"};
  std::vector<std::string> without = command;
  without.insert(without.end(), {"--set", "shape.rounds=0"});
  EXPECT_NE(run_deliso(without).err.find("no stage improves small ones"), std::string::npos);
  EXPECT_EQ(run_deliso(command).err.find("no stage improves small ones"), std::string::npos);
}

// Edges in faces between cells come to lie a hair beside them in single precision, where verify looked at their
// middles.
TEST_F(SizeOptionsTest, EdgesInCellFacesAreSampledAtTheSamePlacesByBoth) {
  const std::string volume = std::string(DELISO_SOURCE_DIR) + "/tests/regression/edge_in_face.nrrd";
  const ProgramResult made =
      run_deliso({"mesh", volume, "--isovalue", "0.5", "--max-error", "0.5", "-o", folder_ / "e.stl"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult verified =
      run_deliso({"verify", folder_ / "e.stl", volume, "--isovalue", "0.5", "--max-distance", "0.5"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

// Where the box closes a volume, just inside the field may rise towards the mesh. By its gradient there verify took the
// component for reversed.
TEST_F(SizeOptionsTest, AClosedVolumeWithHighValuesAtTheBoxIsTheRightSideOut) {
  const std::string volume = std::string(DELISO_SOURCE_DIR) + "/tests/regression/closed_far.nrrd";
  const std::string isovalue = "--isovalue=1.516594969814396";
  const ProgramResult made = run_deliso(
      {"mesh", volume, isovalue, "--set", "boundary=closed", "--max-error", "0.05", "-o", folder_ / "c.off"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult verified = run_deliso({"verify", folder_ / "c.off", volume, isovalue, "--closed"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

TEST_F(SizeOptionsTest, RegionsKeepTheirPlaceInEveryCommand) {
  EXPECT_EQ(mesh({"--region", "14:,:,:"}).exit_code, 0);
  EXPECT_EQ(json("r.json")["components"], 1);
  EXPECT_EQ(verify().exit_code, 0);
  EXPECT_EQ(verify({"--region", ":,:,:"}).exit_code, 1);
  const std::vector<std::string> region = {"--region", "14:,:,:"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), region.begin(), region.end());
    return run_deliso(arguments);
  };
  EXPECT_NE(run({"info", volume()}).out.find("10 14 14"), std::string::npos);
  EXPECT_EQ(run({"topology", volume(), "--isovalue", "99.5", "--report", folder_ / "t.json"}).exit_code, 0);
  EXPECT_EQ(json("t.json")["components"], 1);
  EXPECT_EQ(run({"render", volume(), "--isovalue", "99.5", "-o", folder_ / "p.png"}).exit_code, 0);
}

TEST_F(SizeOptionsTest, BadSizesAreRefusedInOneSentence) {
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--max-error", "0"},
                                      {"--max-error", "-1mm"},
                                      {"--max-error", "1e-7"},
                                      {"--max-error", "1cm"},
                                      {"--max-edge", "x"},
                                      {"--min-angle", "36"},
                                      {"--max-aspect", "2"},
                                      {"--target-vertices", "3"},
                                      {"--target-vertices", "2.5"},
                                      {"--keep-largest", "0"},
                                      {"--min-component", "area:"},
                                      {"--min-component", "weight:3"},
                                      {"--min-component", "0"},
                                      {"--region", "1:2"},
                                      {"--region", "0:99,:,:"},
                                      {"--threads", "some"}}) {
    const ProgramResult refused = mesh({option, value}, "none.ply");
    EXPECT_EQ(refused.exit_code, 2) << option << ' ' << value;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_NE(refused.err.find(option.substr(2)), std::string::npos) << refused.err;
  }
  // What was typed is quoted, units included, and the units that there are named.
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--max-error", "0.1mmm"},
                                      {"--max-error", "0.1um"},
                                      {"--max-edge", "mm"},
                                      {"--smooth", "w"},
                                      {"--min-component", "area:xmm2"}}) {
    const std::string refused = mesh({option, value}, "none.ply").err;
    const std::string power = option == "--min-component" ? "2" : "", number = power.empty() ? "0.5" : "5";
    EXPECT_EQ(refused, "deliso: " + option + ": expected a finite number: of voxels, or like " + number + "mm" + power +
                           ", or " + number + "w" + power + " in the volume's own units, found '" + value + "'\n");
  }
  EXPECT_EQ(mesh({"--threads", "auto"}).exit_code, 0);
}

}  // namespace
}  // namespace deliso::testing
