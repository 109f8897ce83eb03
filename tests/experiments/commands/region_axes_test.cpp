// Regions of volumes whose axes run backwards: samples are counted as the file counts them, by all commands, in
// configs, reports, mesh files and messages.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/program_runner.h"
#include "volume/affine.h"

namespace deliso::testing {
namespace {

constexpr int kBallNx = 14, kBallNy = 10, kBallNz = 9;
constexpr const char* kBallIsovalue = "40.3";

// A small ball near the low end of every axis, a larger one near the high ends.
std::vector<float> two_balls() {
  std::vector<float> samples;
  for (int k = 0; k < kBallNz; ++k)
    for (int j = 0; j < kBallNy; ++j)
      for (int i = 0; i < kBallNx; ++i) {
        const double low = std::hypot(i - 2.6, j - 2.4, k - 2.5) - 1.4,
                     high = std::hypot(i - 9.6, j - 6.1, k - 5.5) - 2;
        samples.push_back(static_cast<float>(40.3 - 10 * std::fmin(low, high)));
      }
  return samples;
}

std::string two_balls_file(const std::string& directions, const std::vector<float>& samples) {
  std::string bytes(samples.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return std::string("NRRD0005\ntype: float\ndimension: 3\nsizes: 14 10 9\nencoding: raw\nendian: ") +
         (std::endian::native == std::endian::little ? "little" : "big") +
         "\nspace: left-posterior-superior\nspace directions: " + directions + "\nspace origin: (90,5,7)\n\n" + bytes;
}

const std::string kBackwards = "(-1,0,0) (0,1,0) (0,0,-1)";
const std::string kTilted = "(-1,0.001,0) (0,1,0) (0,0,-1)";
const std::vector<std::string> kLow = {"--region", "0:5,:6,0:5"};

class RegionAxes : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_ / "a.nrrd", two_balls_file(kBackwards, two_balls()));
    write_file(folder_ / "tilted.nrrd", two_balls_file(kTilted, two_balls()));
  }
  ProgramResult run(std::vector<std::string> arguments, const std::vector<std::string>& more = {}) {
    arguments.insert(arguments.end(), {"--isovalue", kBallIsovalue});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  // The vertices of a mesh of the low ball, as the file counts.
  void expect_low_ball(const std::string& name) {
    const TriangleMesh mesh = read_mesh(folder_ / name);
    ASSERT_FALSE(mesh.points.empty()) << name;
    for (const Vec3& p : mesh.points) {
      EXPECT_LT(norm(Vec3{90 - p.x, p.y - 5, 7 - p.z} - Vec3{2.6, 2.4, 2.5}), 2) << name;
    }
  }
  TemporaryFolder folder_;
};

TEST_F(RegionAxes, TheRegionIsThatOfTheFileOptionsAndConfigsAlike) {
  for (const std::string name : {"a.nrrd", "tilted.nrrd"}) {
    const ProgramResult made = run({"mesh", folder_ / name, "-o", folder_ / "m.ply", "--report", folder_ / "r"}, kLow);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    expect_low_ball("m.ply");
    const Json report = Json::parse(read_file(folder_ / "r"));
    EXPECT_EQ(report["parameters"]["region"]["i1"], 5) << name;
    EXPECT_EQ(report["certificate"]["proven"], true) << name;
    // The mesh file names the region.
    const ProgramResult verified = run({"verify", folder_ / "m.ply", folder_ / name});
    EXPECT_EQ(verified.exit_code, 0) << name << verified.out;
    EXPECT_EQ(run({"verify", folder_ / "m.ply", folder_ / name}, {"--region", ":,:,:"}).exit_code, 1) << name;
  }
  write_file(folder_ / "c.json", R"({"region": {"i1": 5, "j1": 6, "k1": 5}, "spacing": "ignore"})");
  ASSERT_EQ(run({"mesh", folder_ / "a.nrrd", "-o", folder_ / "c.vtp", "--config", folder_ / "c.json"}).exit_code, 0);
  expect_low_ball("c.vtp");
  EXPECT_EQ(run({"verify", folder_ / "c.vtp", folder_ / "a.nrrd"}).exit_code, 0);
}

TEST_F(RegionAxes, TopologyExperimentsAndLessonsCountAlike) {
  for (const std::string name : {"a.nrrd", "tilted.nrrd"}) {
    const auto surface = [&](const std::string& region) {
      const ProgramResult told = run({"topology", folder_ / name}, {"--region", region, "--report", folder_ / "t"});
      EXPECT_EQ(told.exit_code, 0) << told.err;
      const Json report = Json::parse(read_file(folder_ / "t"));
      return std::pair(report["components"].get<int>(), report["boundary_loops"].get<int>());
    };
    EXPECT_EQ(surface(":,:,:"), std::pair(2, 0)) << name;
    EXPECT_EQ(surface("0:5,:6,0:5"), std::pair(1, 0)) << name;
    EXPECT_EQ(surface("0:3,:3,:"), std::pair(1, 1)) << name;
    EXPECT_EQ(run({"topology", folder_ / name}, {"--region", "8:,:3,:"}).exit_code, 2) << name;
  }
  // No ball is in the region that counts from the other end of x.
  const ProgramResult told =
      run({"explain", folder_ / "a.nrrd", "--text"}, {"--set", "region.i1=5", "--set", "region.j1=3"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_EQ(run({"explain", folder_ / "a.nrrd", "--text"}, {"--set", "region.i0=8", "--set", "region.j1=3"}).exit_code,
            2);
  std::filesystem::create_directories(folder_ / "data");
  write_file(folder_ / "data/a.nrrd", two_balls_file(kBackwards, two_balls()));
  write_file(folder_ / "e.json", R"({"title": "A part",
    "base": {"name": "low", "parameters": {"region": {"i1": 5, "j1": 6, "k1": 5}}},
    "datasets": [{"name": "A", "file": "a.nrrd", "isovalue": 40.3}], "variants": [{"name": "part", "extends": "low"}],
    "metrics": [{"name": "vertices", "value": "vertices"}]})");
  const ProgramResult made =
      run_deliso({"run", folder_ / "e.json", "--out", folder_ / "out", "--data", folder_ / "data"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Json record = Json::parse(read_file(folder_ / "out/records.jsonl"));
  EXPECT_EQ(record["components"], 1) << record.dump();
  EXPECT_EQ(record["boundary_loops"], 0);
}

TEST_F(RegionAxes, InfoAndReportsHaveTheMapOfTheFile) {
  const ProgramResult told = run_deliso({"info", folder_ / "a.nrrd"});
  const std::size_t row = told.out.find("index to world");
  ASSERT_NE(row, std::string::npos);
  EXPECT_NE(told.out.substr(row, told.out.find('\n', row) - row).find(" -1 0 0 90"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("0 0 -1 7"), std::string::npos) << told.out;
  // That of a part begins at the part's first sample.
  ASSERT_EQ(run({"mesh", folder_ / "a.nrrd", "-o", folder_ / "m.ply"}, {"--region", "0:5,:6,0:5"}).exit_code, 0);
  const ProgramResult verified =
      run({"verify", folder_ / "m.ply", folder_ / "a.nrrd"}, {"--region", "1:5,1:6,1:5", "--report", folder_ / "v"});
  EXPECT_EQ(Json::parse(read_file(folder_ / "v"))["volume"]["index_to_world"],
            Json::parse("[[-1, 0, 0, 89], [0, 1, 0, 6], [0, 0, -1, 6]]"))
      << verified.err;
}

TEST_F(RegionAxes, MessagesNameSamplesAndRegionsAsTheFileDoes) {
  std::vector<float> samples = two_balls();
  samples[12 + kBallNx * (3 + kBallNy * 2)] = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& map : {kBackwards, kTilted}) {
    write_file(folder_ / "n.nrrd", two_balls_file(map, samples));
    for (const std::string region : {":,:,:", "10:,1:8,1:"}) {
      const ProgramResult topology = run({"topology", folder_ / "n.nrrd"}, {"--region", region});
      EXPECT_NE(topology.err.find("sample (12, 3, 2) is NaN"), std::string::npos) << topology.err;
      const ProgramResult mesh = run({"mesh", folder_ / "n.nrrd", "-o", folder_ / "n.ply", "--region", region});
      EXPECT_NE(mesh.err.find("sample (12, 3, 2) is NaN"), std::string::npos) << mesh.err;
    }
    // In the other half there is none; the mesher is told which half that is.
    const ProgramResult other = run({"topology", folder_ / "n.nrrd"}, {"--region", "0:5,:6,0:5"});
    EXPECT_EQ(other.exit_code, 0) << other.err;
    ASSERT_EQ(run({"mesh", folder_ / "n.nrrd", "-o", folder_ / "n.ply", "--nan", "outside"}, kLow).exit_code, 0);
    expect_low_ball("n.ply");
    const ProgramResult beyond =
        run({"mesh", folder_ / "n.nrrd", "-o", folder_ / "n.ply", "--nan", "outside"}, {"--region", "9:14,:,:"});
    EXPECT_NE(
        beyond.err.find("along x the volume has the samples 0 to 13, expected at least two of them, found 9 to 14"),
        std::string::npos)
        << beyond.err;
  }
}

// A region is meshed as a file of its samples alone, whatever lies beyond it.
TEST_F(RegionAxes, NotANumberIsAsFarBeyondTheIsovalueAsSamplesOfTheRegion) {
  std::vector<float> samples = two_balls();
  samples[2 + kBallNx * (3 + kBallNy * 2)] = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> others = samples;
  others[13] = -5e4F;
  for (const std::string side : {"inside", "outside"}) {
    std::vector<std::string> bodies;
    for (const std::vector<float>& all : {samples, others}) {
      write_file(folder_ / "n.nrrd", two_balls_file(kTilted, all));
      const ProgramResult result = run({"mesh", folder_ / "n.nrrd", "-o", folder_ / "n.ply", "--nan", side}, kLow);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(run({"verify", folder_ / "n.ply", folder_ / "n.nrrd"}, {"--nan", side}).exit_code, 0);
      const std::string file = read_file(folder_ / "n.ply");
      bodies.push_back(file.substr(file.find("end_header")));
    }
    EXPECT_TRUE(bodies[0] == bodies[1]) << side;
  }
}

}  // namespace
}  // namespace deliso::testing
