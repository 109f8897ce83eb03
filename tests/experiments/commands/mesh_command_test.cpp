// `deliso mesh` from end to end: its report, its exit codes, its reproducibility, and how it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/certificate/certificate.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/program_runner.h"
#include "volume/fields/field_slices.h"
#include "volume/io/nrrd/nrrd.h"

namespace deliso::testing {
namespace {

// Key paths of the report that others rely on; written out from the documentation.
const std::vector<std::string> kReportKeys = {"schema",
                                              "program.version",
                                              "program.commit",
                                              "program.compiler",
                                              "program.flags",
                                              "program.cpu",
                                              "volume.path",
                                              "volume.dims",
                                              "volume.spacing",
                                              "volume.type",
                                              "volume.sha256",
                                              "isovalue",
                                              "isovalue_used",
                                              "seed",
                                              "vertices",
                                              "triangles",
                                              "components",
                                              "euler_characteristic",
                                              "boundary_loops",
                                              "total_seconds",
                                              "peak_memory_bytes",
                                              "parameters.algorithm",
                                              "parameters.stage1.epsilon",
                                              "parameters.stage2.max_distance",
                                              "stages.index.seconds",
                                              "stages.initial.seconds",
                                              "stages.recover.seconds",
                                              "stages.poles.seconds",
                                              "stages.build.seconds",
                                              "stages.refine.seconds",
                                              "stages.certify.seconds",
                                              "stages.recover.insertions",
                                              "stages.recover.seconds_per_insertion",
                                              "stages.recover.searches",
                                              "stages.recover.solves",
                                              "stages.recover.searches_hit",
                                              "stages.recover.solves_hit",
                                              "stages.recover.multi_intersect",
                                              "stages.recover.extract_manifold",
                                              "stages.recover.approximate_geometry",
                                              "stages.recover.share_restricted",
                                              "stages.refine.insertions",
                                              "stages.refine.seconds_per_insertion",
                                              "stages.refine.searches",
                                              "stages.refine.solves",
                                              "stages.refine.searches_hit",
                                              "stages.refine.solves_hit",
                                              "stages.refine.refused",
                                              "stages.refine.stopped_at_r_min",
                                              "certificate.verdict",
                                              "certificate.manifold",
                                              "certificate.oriented",
                                              "certificate.mesh",
                                              "certificate.isosurface",
                                              "certificate.differences",
                                              "quality.min_angle_degrees",
                                              "quality.mean_min_angle_degrees",
                                              "quality.max_angle_degrees",
                                              "quality.radius_edge_max",
                                              "quality.radius_edge_p99",
                                              "quality.fraction_min_angle_below_30"};

const Json* find_path(const Json& report, const std::string& path) {
  const Json* node = &report;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string key = path.substr(begin, end - begin);
    if (!node->is_object() || !node->contains(key)) return nullptr;
    node = &(*node)[key];
    begin = end + 1;
  }
  return node;
}

// A folder with the built-in volume `name` as v.nrrd.
class MeshCommand : public ::testing::Test {
 protected:
  void generate(const std::string& name, int size) {
    const ProgramResult result =
        run_deliso({"generate", name, "--size", std::to_string(size), "-o", folder_ / "v.nrrd"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  // Meshes v.nrrd into m.ply with the report r.json.
  ProgramResult mesh(const std::string& isovalue, const std::vector<std::string>& options = {},
                     std::optional<SignalAfter> signal = std::nullopt) {
    std::vector<std::string> arguments = {"mesh", folder_ / "v.nrrd", "--isovalue", isovalue,
                                          "-o",   folder_ / "m.ply",  "--report",   folder_ / "r.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_deliso(arguments, signal);
  }
  Json report() { return read_json(folder_ / "r.json"); }

  TemporaryFolder folder_;
};

TEST_F(MeshCommand, ReportHasEveryDocumentedKey) {
  generate("sphere", 20);
  const ProgramResult result = mesh("0.3");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json json = report();
  for (const std::string& path : kReportKeys) EXPECT_NE(find_path(json, path), nullptr) << path;
  EXPECT_EQ(json["schema"], "deliso-report-1");
  EXPECT_EQ(json["certificate"]["verdict"], "homeomorphic");
  EXPECT_EQ(json["components"], 1);
  EXPECT_EQ(json["euler_characteristic"], 2);
  EXPECT_GT(json["peak_memory_bytes"].get<std::int64_t>(), 1 << 20);
}

TEST_F(MeshCommand, ReportAgreesWithTheMesh) {
  generate("torus", 24);
  ASSERT_EQ(mesh("0.7").exit_code, 0);
  const Json json = report();
  const TriangleMesh read = read_mesh(folder_ / "m.ply");
  EXPECT_EQ(json["vertices"], read.points.size());
  EXPECT_EQ(json["triangles"], read.triangles.size());
  EXPECT_EQ(component_topologies(read), (std::vector<ComponentTopology>{{0, 0}}));
}

TEST_F(MeshCommand, SecondsOfTheStagesAddUp) {
  generate("shells", 64);
  // The best of a few runs: a busy machine may interrupt the program between two stages.
  double best = 1;
  for (int i = 0; i < 5 && best > 0.02; ++i) {
    ASSERT_EQ(mesh("100.5").exit_code, 0);
    const Json json = report();
    double sum = 0;
    for (const Json& stage : json["stages"]) sum += stage["seconds"].get<double>();
    best = std::min(best, std::abs(sum / json["total_seconds"].get<double>() - 1));
  }
  EXPECT_LE(best, 0.02);
}

TEST_F(MeshCommand, EqualRunsGiveEqualBytes) {
  generate("linked_tori", 32);
  ASSERT_EQ(mesh("0.9", {"--seed", "5"}).exit_code, 0);
  const std::string first = read_file(folder_ / "m.ply");
  ASSERT_EQ(mesh("0.9", {"--seed", "5"}).exit_code, 0);
  EXPECT_EQ(first, read_file(folder_ / "m.ply"));
  EXPECT_FALSE(first.empty());
}

TEST_F(MeshCommand, SummaryAndAsciiAndStage1) {
  generate("sphere", 20);
  const ProgramResult result = mesh("0.3", {"--ascii", "--stage1-out", folder_ / "s.off", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(read_file(folder_ / "m.ply").starts_with("ply\nformat ascii 1.0\n"));
  for (const std::string row : {"vertices", "triangles", "components", "euler characteristic", "boundary loops",
                                "verdict", "min angle", "seconds"}) {
    EXPECT_NE(result.out.find(row), std::string::npos) << row;
  }
  // Stage 2 only adds vertices.
  const TriangleMesh stage1 = read_mesh(folder_ / "s.off");
  EXPECT_GE(stage1.points.size(), 4u);
  EXPECT_LE(stage1.points.size(), read_mesh(folder_ / "m.ply").points.size());
}

TEST_F(MeshCommand, ParametersComeFromTheFileAndThenFromSet) {
  generate("sphere", 20);
  write_file(folder_ / "p.json", R"({"stage2": {"epsilon1": 0.4, "epsilon2": 0.9}, "certify": false})");
  const ProgramResult result =
      mesh("0.3", {"--config", folder_ / "p.json", "--set", "stage2.epsilon2=0.8", "--set", "repair.max_rounds=2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json json = report();
  EXPECT_EQ(json["parameters"]["stage2"]["epsilon1"], 0.4);
  EXPECT_EQ(json["parameters"]["stage2"]["epsilon2"], 0.8);
  EXPECT_EQ(json["parameters"]["repair"]["max_rounds"], 2);
  EXPECT_EQ(json["parameters"]["stage1"]["epsilon"], 0.2);
  EXPECT_EQ(json["certificate"]["verdict"], "not_checked");
  EXPECT_EQ(json["euler_characteristic"], 2);
}

TEST_F(MeshCommand, IsovalueOnASampleIsMovedAndSaidSo) {
  generate("shells", 32);
  const ProgramResult result = mesh("100");
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.err;
  const Json json = report();
  EXPECT_EQ(json["isovalue"], 100);
  EXPECT_LT(json["isovalue_used"].get<double>(), 100);
  EXPECT_GT(json["isovalue_used"].get<double>(), 99);
  EXPECT_NE(result.err.find("a sample equals the isovalue"), std::string::npos);
}

// 4 values: 1.01 is beside samples, and 1.5 has the same samples inside. Values without steps have no such gap.
TEST_F(MeshCommand, AnIsovalueBesideSamplesIsRemarked) {
  const char* const remark = "no sample lies between 1 and 2, so --isovalue 1.5 has the same samples inside";
  std::vector<std::uint8_t> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint8_t>(i * i % 101 % 4);
  write_volume(ScalarGrid({10, 10, 10}, std::move(samples)), folder_ / "v.nrrd");
  EXPECT_NE(mesh("1.01").err.find(remark), std::string::npos);
  EXPECT_EQ(mesh("1.5").err.find("has the same samples inside"), std::string::npos);
  generate("noise", 10);
  EXPECT_EQ(mesh("100.01").err.find("has the same samples inside"), std::string::npos);
}

TEST_F(MeshCommand, VertexBudgetStopsWithAValidPartialMesh) {
  generate("shells", 48);
  const ProgramResult result = mesh("100.5", {"--set", "budget.max_vertices=200"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const Json json = report();
  EXPECT_TRUE(json["stopped_early"].get<bool>());
  ASSERT_FALSE(json["unmet"].empty());
  EXPECT_NE(json["unmet"][0].get<std::string>().find("budget.max_vertices = 200"), std::string::npos);
  const TriangleMesh partial = read_mesh(folder_ / "m.ply");
  EXPECT_GT(partial.triangles.size(), 0u);
  EXPECT_TRUE(certify(partial, std::vector<ComponentTopology>()).manifold);
  // What was not checked is not promised.
  EXPECT_EQ(json["certificate"]["proven"], false);
  EXPECT_NE(json["certificate"]["broken"].dump().find("the run was stopped before"), std::string::npos);
  EXPECT_TRUE(json["promised_distance_voxels"].is_null());
  for (const std::string& comment : read_mesh_file(folder_ / "m.ply").comments)
    EXPECT_FALSE(comment.starts_with("promise")) << comment;
}

TEST_F(MeshCommand, SignalsStopWithAValidPartialMesh) {
  generate("gyroid", 24);
  for (const int signal : {SIGINT, SIGTERM}) {
    // Few samples for stage 1, and so fine that stage 2 keeps any machine busy for much longer than the delay.
    const ProgramResult result =
        mesh("0.1", {"--set", "stage2.epsilon2=0.001", "--set", "stage2.epsilon1=0.001", "--set", "stage2.r_min=1e-7"},
             SignalAfter{signal, std::chrono::milliseconds(1500)});
    EXPECT_EQ(result.exit_code, 3) << result.err << " after " << result.seconds << " s";
    const Json json = report();
    EXPECT_EQ(json["unmet"][0].get<std::string>().find("stage 2 (refine) was stopped by a signal"), 0u);
    EXPECT_EQ(json["stopped_in"], "refine");
    const TriangleMesh partial = read_mesh(folder_ / "m.ply");
    EXPECT_TRUE(certify(partial, std::vector<ComponentTopology>()).manifold);
    std::filesystem::remove(folder_ / "m.ply");
  }
}

// However many points a run is to start with.
TEST_F(MeshCommand, RandomPointsEndWithTheRun) {
  generate("sphere", 12);
  const std::vector<std::string> many = {"--set", "initial.random_points=2147483647"};
  const ProgramResult stopped = mesh("0.3", many, SignalAfter{SIGINT, std::chrono::milliseconds(500)});
  EXPECT_EQ(stopped.exit_code, 3) << stopped.err << " after " << stopped.seconds << " s";
  EXPECT_EQ(report()["stopped_in"], "initial");
  EXPECT_TRUE(certify(read_mesh(folder_ / "m.ply"), std::vector<ComponentTopology>()).manifold);
  const ProgramResult spent = mesh("0.3", {"--set", "initial.random_points=2147483647", "--set", "budget.seconds=0.3"});
  EXPECT_EQ(spent.exit_code, 3) << spent.err;
}

// More points than are triangulated at once.
TEST_F(MeshCommand, ManyRandomPointsAreAllStartedFrom) {
  generate("sphere", 24);
  ASSERT_EQ(mesh("0.3", {"--set", "initial.random_points=21000", "--set", "r_min_of=box"}).exit_code, 0);
  EXPECT_GT(report()["vertices"].get<std::int64_t>(), 20500);
  EXPECT_EQ(run_deliso({"verify", folder_ / "m.ply", folder_ / "v.nrrd", "--isovalue", "0.3"}).exit_code, 0);
}

TEST_F(MeshCommand, OwnMeshesVerify) {
  generate("torus", 24);
  ASSERT_EQ(mesh("0.7").exit_code, 0);
  const ProgramResult result = run_deliso(
      {"verify", folder_ / "m.ply", folder_ / "v.nrrd", "--isovalue", "0.7", "--report", folder_ / "c.json"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(read_json(folder_ / "c.json")["proven"].get<bool>());
}

// A stretched volume meshed and verified without its spacing is judged as the same samples with spacing 1.
TEST_F(MeshCommand, VerifyCanIgnoreTheSpacingAsMeshCan) {
  const ScalarGrid cubic = generate_field("torus", 20);
  const ScalarGrid stretched(cubic.dims(), cubic.samples(), {1, 2, 4}, {8, -16, 32});
  // The mesh as another program would write it, without our comments.
  const auto quality = [&](const ScalarGrid& grid, const std::vector<std::string>& options) {
    write_nrrd(grid, folder_ / "v.nrrd");
    EXPECT_EQ(mesh("0.7", {"--set", "spacing=ignore"}).exit_code, 0);
    write_mesh(read_mesh(folder_ / "m.ply"), folder_ / "m.ply");
    std::vector<std::string> arguments = {"verify", folder_ / "m.ply", folder_ / "v.nrrd", "--isovalue",
                                          "0.7",    "--report",        folder_ / "c.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_deliso(arguments).exit_code, 0);
    const Json json = read_json(folder_ / "c.json");
    EXPECT_EQ(json["spacing"], options.empty() ? "use" : "ignore");
    EXPECT_TRUE(json["proven"].get<bool>());
    return json["quality"]["mean_min_angle_degrees"].get<double>();
  };
  const double of_cubic = quality(cubic, {});
  EXPECT_NEAR(quality(stretched, {"--ignore-spacing"}), of_cubic, 1e-9);
  EXPECT_GT(std::abs(quality(stretched, {}) - of_cubic), 1);
}

TEST_F(MeshCommand, VerifyTellsAWrongMesh) {
  generate("torus", 24);
  ASSERT_EQ(mesh("0.7").exit_code, 0);
  TriangleMesh damaged = read_mesh(folder_ / "m.ply");
  damaged.triangles.pop_back();
  write_mesh(damaged, folder_ / "d.ply");
  const ProgramResult result = run_deliso(
      {"verify", folder_ / "d.ply", folder_ / "v.nrrd", "--isovalue", "0.7", "--report", folder_ / "c.json"});
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  const Json json = read_json(folder_ / "c.json");
  EXPECT_FALSE(json["proven"].get<bool>());
  EXPECT_FALSE(json["checks"]["boundary"]["pass"].get<bool>());
  EXPECT_FALSE(json["failures"].empty());
}

}  // namespace
}  // namespace deliso::testing
