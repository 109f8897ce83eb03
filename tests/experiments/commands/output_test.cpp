// What a command writes takes the place of nothing else, and holds what the program says of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/system/output_names.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

template <class Sample>
std::string bytes_of(const std::vector<Sample>& samples) {
  std::string bytes(sizeof(Sample) * samples.size(), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

// A ball of 8 x 8 x 8 samples: values above 0 within 2.3 samples of the middle.
std::string ball(const std::string& fields) {
  std::vector<float> samples;
  for (int n = 0; n < 512; ++n) {
    samples.push_back(2.3f - std::hypot(static_cast<float>(n % 8) - 3.4f, static_cast<float>(n / 8 % 8) - 3.5f,
                                        static_cast<float>(n / 64) - 3.6f));
  }
  return "NRRD0004\ntype: float\ndimension: 3\nsizes: 8 8 8\nendian: little\nencoding: raw\n" + fields + "\n" +
         bytes_of(samples);
}

class Output : public ::testing::Test {
 protected:
  Output() {
    write_file(volume_, ball(""));
    write_file(config_, "{}");
    write_file(mesh_, "ply\n");
    fs::create_symlink(volume_, folder_ / "link.json");
    fs::create_hard_link(config_, folder_ / "hard.json");
  }
  // Refused with exit code 2 and one line; every file is as it was.
  void expect_clash(const std::vector<std::string>& arguments, const std::string& first, const std::string& second) {
    SCOPED_TRACE(arguments.back());
    const std::vector<std::string> names = folder_.names();
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(first + ": names the same file as " + second), std::string::npos) << result.err;
    EXPECT_EQ(folder_.names(), names);
    EXPECT_EQ(read_file(volume_), ball(""));
    EXPECT_EQ(read_file(config_), "{}");
    EXPECT_EQ(read_file(mesh_), "ply\n");
  }
  [[nodiscard]] std::vector<std::string> mesh(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"mesh", volume_, "--isovalue", "0", "--config", config_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd";
  std::string config_ = folder_ / "c.json";
  std::string mesh_ = folder_ / "m.ply";
};

TEST_F(Output, TakesThePlaceOfNoOtherOutput) {
  const std::string again = folder_ / "./m.ply";
  expect_clash(mesh({"-o", mesh_, "--report", mesh_}), "--report", "-o");
  expect_clash(mesh({"-o", mesh_, "--report", again}), "--report", "-o");
  expect_clash(mesh({"-o", mesh_, "--stage1-out", again}), "--stage1-out", "-o");
  fs::create_symlink("later.ply", folder_ / "dangling.ply");
  expect_clash(mesh({"-o", folder_ / "dangling.ply", "--stage1-out", folder_ / "later.ply"}), "--stage1-out", "-o");
  // Neither is there yet.
  expect_clash(mesh({"-o", folder_ / "new.ply", "--stage1-out", folder_ / "././new.ply"}), "--stage1-out", "-o");
  expect_clash(mesh({"-o", mesh_, "--stage1-out", folder_ / "s.ply", "--report", folder_ / "s.ply"}), "--report",
               "--stage1-out");
}

TEST_F(Output, TakesThePlaceOfNoInput) {
  const std::string link = folder_ / "link.json", hard = folder_ / "hard.json";
  for (const std::string& report : {volume_, link}) {
    expect_clash(mesh({"-o", folder_ / "new.ply", "--report", report}), "--report", "VOLUME");
    expect_clash({"info", volume_, "--report", report}, "--report", "VOLUME");
    expect_clash({"topology", volume_, "--isovalue", "0", "--report", report}, "--report", "VOLUME");
    expect_clash({"verify", mesh_, volume_, "--isovalue", "0", "--report", report}, "--report", "VOLUME");
  }
  for (const std::string& report : {config_, hard}) {
    expect_clash(mesh({"-o", folder_ / "new.ply", "--report", report}), "--report", "--config");
  }
  expect_clash({"verify", mesh_, volume_, "--isovalue", "0", "--report", mesh_}, "--report", "MESH");
}

// Files that a header names hold the samples: one, a numbered row, a list, and the .img beside a .hdr.
TEST_F(Output, TakesThePlaceOfNoDataFileOfAHeader) {
  const std::string whole = ball(""), samples = whole.substr(whole.find("\n\n") + 2);
  const std::string fields = "NRRD0004\ntype: float\ndimension: 3\nsizes: 8 8 8\nendian: little\nencoding: raw\n";
  const std::string meta = "NDims = 3\nDimSize = 8 8 8\nElementType = MET_FLOAT\nElementDataFile = ";
  write_file(folder_ / "s.raw", samples);
  write_file(folder_ / "p1.raw", samples.substr(0, 1024));
  write_file(folder_ / "p2.raw", samples.substr(1024));
  write_file(folder_ / "one.nhdr", fields + "data file: s.raw\n");
  write_file(folder_ / "list.nhdr", fields + "data file: LIST\np1.raw\np2.raw\n");
  write_file(folder_ / "row.nhdr", fields + "data file: p%d.raw 1 2 1\n");
  write_file(folder_ / "one.mhd", meta + "s.raw\n");
  write_file(folder_ / "list.mhd", meta + "LIST\np1.raw\np2.raw\n");
  fs::create_symlink(folder_ / "p2.raw", folder_ / "other");
  for (const auto& [header, data] : {std::pair<std::string, std::string>{"one.nhdr", "s.raw"},
                                     {"list.nhdr", "p1.raw"},
                                     {"list.nhdr", "other"},
                                     {"row.nhdr", "p2.raw"},
                                     {"one.mhd", "s.raw"},
                                     {"list.mhd", "p2.raw"}}) {
    SCOPED_TRACE(header);
    const std::string volume = folder_ / header, taken = folder_ / data, before = read_file(taken);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"mesh", volume, "--isovalue", "0", "-o", folder_ / "new.ply", "--report", taken},
          {"mesh", volume, "--isovalue", "0", "-o", taken, "--format", "ply"},
          {"info", volume, "--report", taken},
          {"topology", volume, "--isovalue", "0", "--report", taken}})
      expect_clash(arguments, arguments[0] == "mesh" && arguments[5] == taken ? "-o" : "--report",
                   "the samples of VOLUME");
    EXPECT_EQ(read_file(taken), before);
  }
}

// A table of an experiment is no experiment, but may have its name.
TEST_F(Output, TakesThePlaceOfNoExperiment) {
  const std::string experiment = R"({"name":"n","title":"t","datasets":[{"name":"s","field":"sphere","size":12}],)"
                                 R"("base":{"name":"d","parameters":{}},"variants":[{"name":"a","extends":"d"}],)"
                                 R"("metrics":[{"name":"v","value":"vertices"}]})";
  const std::string here = folder_.path().string();
  for (const std::string name : {"table.json", "experiment.json"}) {
    const std::string file = folder_ / name;
    write_file(file, experiment);
    expect_clash({"run", file, "--out", here}, "--out", "EXPERIMENT");
    EXPECT_EQ(read_file(file), experiment);
  }
  expect_clash({"table", here, "--experiment", folder_ / "table.json"}, "-o", "--experiment");
  // Nor of one with the name of its plot.
  const std::string plot = folder_ / "p.svg",
                    plotted = experiment.substr(0, experiment.size() - 1) +
                              R"(,"plots":[{"name":"p","title":"P","kind":"bars","y":["v"]}]})";
  write_file(plot, plotted);
  expect_clash({"run", plot, "--out", here}, "--out", "EXPERIMENT");
  expect_clash({"table", here, "--experiment", plot}, "-o", "--experiment");
  EXPECT_EQ(read_file(plot), plotted);
  // What a run leaves there is its own file, with which another may begin.
  const std::string out = folder_ / "out";
  fs::remove(folder_ / "experiment.json");
  ASSERT_EQ(run_deliso({"run", folder_ / "table.json", "--out", out}).exit_code, 0);
  EXPECT_EQ(run_deliso({"run", out + "/experiment.json", "--out", out, "--resume"}).exit_code, 0);
}

TEST(OutputNames, DevicesAndEmptyNamesAreNoFiles) {
  check_distinct({{"in", "/dev/null"}, {"none", ""}}, {{"a", "/dev/null"}, {"b", "/dev/null"}, {"c", ""}, {"d", ""}});
}

// A report that cannot be written leaves no mesh that lacks it.
TEST_F(Output, NoMeshWithoutItsReport) {
  const std::string out = folder_ / "new.ply";
  const ProgramResult result = run_deliso(mesh({"-o", out, "--report", "/dev/full"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("/dev/full"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(out));
}

// Half a voxel is less than a float can tell there: PLY holds the mesh, STL does not, and verify agrees on both.
TEST_F(Output, AQuietRunSaysNothingOnStandardError) {
  const ProgramResult told = run_deliso(mesh({"-o", "-"}));
  EXPECT_NE(told.err.find("verdict"), std::string::npos) << told.err;
  for (const std::string stream : {"-o", "--report"}) {
    std::vector<std::string> more = {stream, "-", "--quiet"};
    if (stream != "-o") more.insert(more.end(), {"-o", folder_ / "new.ply"});
    const ProgramResult quiet = run_deliso(mesh(more));
    EXPECT_EQ(quiet.exit_code, 0);
    EXPECT_EQ(quiet.err, "") << stream;
    EXPECT_NE(quiet.out, "") << stream;
  }
}

TEST_F(Output, MeshesThatRoundingSpoilsAreNotCalledProven) {
  write_file(volume_, ball("spacings: 0.1 0.1 0.1\naxis mins: 500000 4000000 0\n"));
  const std::string report = folder_ / "r.json";
  for (const std::string name : {"far.ply", "far.stl"}) {
    SCOPED_TRACE(name);
    const bool is_kept = name.ends_with(".ply");
    const ProgramResult result = run_deliso(mesh({"-o", folder_ / name, "--report", report}));
    EXPECT_EQ(result.exit_code, is_kept ? 0 : 1) << result.err;
    EXPECT_EQ(result.err.find("STL rounds coordinates") == std::string::npos, is_kept) << result.err;
    const Json json = Json::parse(read_file(report));
    EXPECT_EQ(json["certificate"]["verdict"], "homeomorphic");
    EXPECT_EQ(json["certificate"]["proven"], is_kept);
    EXPECT_EQ(json["certificate"]["broken"].empty(), is_kept);
    EXPECT_EQ(run_deliso({"verify", folder_ / name, volume_, "--isovalue", "0"}).exit_code, is_kept ? 0 : 1);
  }
}

// Samples over 24 decades: corners that single precision brings into one line. A tilted map to the world does so only
// once it is undone, which is not what is written.
TEST_F(Output, TrianglesThatRoundingLeavesWithoutAreaAreNotCalledProven) {
  for (const auto& [volume, name, code] :
       {std::tuple{"flat_when_rounded.nrrd", "flat.stl", 1}, std::tuple{"flat_in_world.nrrd", "flat.ply", 0}}) {
    SCOPED_TRACE(name);
    const std::string path = std::string(DELISO_SOURCE_DIR) + "/tests/regression/" + volume, written = folder_ / name;
    const ProgramResult result = run_deliso({"mesh", path, "--isovalue", "0", "-o", written});
    EXPECT_EQ(result.exit_code, run_deliso({"verify", written, path, "--isovalue", "0"}).exit_code) << result.err;
    EXPECT_EQ(result.exit_code, code);
    EXPECT_EQ(result.err.find("no area") != std::string::npos, code == 1) << result.err;
  }
}

// A float is off by half a hundredth of a voxel there, which keeps the triangles apart but is more than verify allows.
TEST_F(Output, StlOfVerticesThatRoundingMovesFarIsNotCalledProven) {
  write_file(volume_, ball("axis mins: 100000 100000 100000\n"));
  const std::string out = folder_ / "far.stl";
  const ProgramResult result = run_deliso(mesh({"-o", out}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("vertices move by up to 0.00"), std::string::npos) << result.err;
  EXPECT_EQ(run_deliso({"verify", out, volume_, "--isovalue", "0"}).exit_code, 1);
}

TEST_F(Output, StlBeyondTheRangeOfFloatsIsRefusedByName) {
  write_file(volume_, ball("spacings: 1e39 1e39 1e39\n"));
  for (const std::string certify : {"true", "false"}) {
    const std::string out = folder_ / "huge.stl";
    const ProgramResult result = run_deliso(mesh({"-o", out, "--set", "certify=" + certify}));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find("huge.stl: STL holds floats"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

// A process inherits the peak of the one that starts it.
TEST_F(Output, PeakMemoryIsThatOfTheProgramAlone) {
  constexpr std::size_t kBytes = std::size_t{800} << 20;
  const std::string ballast(kBytes, 'x');
  const std::string report = folder_ / "r.json";
  ASSERT_EQ(run_deliso(mesh({"-o", folder_ / "m.ply", "--report", report})).exit_code, 0);
  EXPECT_LT(Json::parse(read_file(report))["peak_memory_bytes"].get<std::size_t>(), kBytes / 2) << ballast.size();
}

TEST_F(Output, StlOfMeshesNearTheOriginIsProven) {
  const std::string out = folder_ / "near.stl";
  EXPECT_EQ(run_deliso(mesh({"-o", out})).exit_code, 0);
  EXPECT_EQ(run_deliso({"verify", out, volume_, "--isovalue", "0"}).exit_code, 0);
}

TEST_F(Output, VolumesThatCoordinatesCannotTellApartAreRefused) {
  for (const std::string fields : {"axis mins: 1e17 0 0\n", "spacings: 1e140 1e140 1e140\n"}) {
    write_file(volume_, ball(fields));
    const ProgramResult result = run_deliso(mesh({"-o", folder_ / "new.ply"}));
    EXPECT_EQ(result.exit_code, 2) << fields;
    EXPECT_NE(result.err.find("v.nrrd"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("spacing"), std::string::npos) << result.err;
  }
}

TEST_F(Output, SpacingsTooUnequalAreRefusedUnlessIgnored) {
  write_file(volume_, ball("spacings: 1 1 1001\n"));
  const ProgramResult refused = run_deliso(mesh({"-o", folder_ / "new.ply"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("1 1 1001"), std::string::npos) << refused.err;
  EXPECT_EQ(run_deliso(mesh({"-o", folder_ / "new.ply", "--set", "spacing=ignore"})).exit_code, 0);
}

// A face with 0 and 2 at its corners, crosswise, has a saddle of value 1.
TEST_F(Output, ASaddleOnTheIsovalueIsToldApartFromASample) {
  std::vector<unsigned char> samples(64, 0);
  samples[21] = samples[26] = 2;  // (1, 1, 1) and (2, 2, 1): diagonal on a face
  write_file(volume_, "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + bytes_of(samples));
  const std::string report = folder_ / "r.json";
  for (const std::string command : {"topology", "mesh", "verify"}) {
    std::vector<std::string> arguments = {command, volume_, "--isovalue", "1", "--report", report};
    if (command == "verify") arguments.insert(arguments.begin() + 1, folder_ / "s.ply");
    if (command == "mesh") arguments.insert(arguments.end(), {"-o", folder_ / "s.ply"});
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 0) << command << ": " << result.err << result.out;
    EXPECT_NE(result.err.find("a saddle of the interpolant equals the isovalue 1"), std::string::npos) << result.err;
    const Json json = Json::parse(read_file(report));
    EXPECT_LT(json["isovalue_used"].get<double>(), 1);
    EXPECT_GT(json["isovalue_used"].get<double>(), 0.9);
  }
}

}  // namespace
}  // namespace deliso::testing
