// What a run tells of itself makes its mesh again: reports and lines of records.jsonl, given as --config.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

class ReportAsConfig : public ::testing::Test {
 protected:
  ReportAsConfig() { EXPECT_EQ(run_deliso({"generate", "sphere", "--size", "8", "-o", volume_}).exit_code, 0); }

  // The bytes of the mesh made with these options.
  std::string mesh_bytes(const std::vector<std::string>& options) {
    const std::string mesh = folder_ / "m.ply";
    std::vector<std::string> arguments = {"mesh", volume_, "--isovalue", "0.1", "-o", mesh};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? read_file(mesh) : "";
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd";
};

TEST_F(ReportAsConfig, AReportMakesTheSameMesh) {
  const std::string report = folder_ / "r.json";
  const std::vector<std::vector<std::string>> runs = {
      {}, {"--set", "stage2.epsilon1=0.3", "--invert", "--closed"}, {"--smooth", "0.8", "--min-component", "5"}};
  const std::string plain = mesh_bytes({});
  for (const std::vector<std::string>& run : runs) {
    std::vector<std::string> options = run;
    options.insert(options.end(), {"--report", report});
    const std::string mesh = mesh_bytes(options);
    EXPECT_EQ(mesh == plain, run.empty());
    EXPECT_EQ(mesh_bytes({"--config", report}), mesh) << run.size();
  }
}

TEST_F(ReportAsConfig, ALineOfRecordsMakesTheSameMesh) {
  Json document = small_document();
  document["datasets"] = Json::array({Json{{"name", "ball"}, {"field", "sphere"}, {"size", 6}}});
  document["base"]["parameters"]["stage2"]["epsilon1"] = 0.3;
  document["repeats"] = 1;
  write_file(folder_ / "e.json", document.dump());
  ASSERT_EQ(run_deliso({"run", folder_ / "e.json", "--out", folder_ / "out"}).exit_code, 0);
  const std::string records = read_file(folder_ / "out/records.jsonl");
  write_file(folder_ / "record.json", records.substr(0, records.find('\n')));
  EXPECT_EQ(mesh_bytes({"--config", folder_ / "record.json"}),
            mesh_bytes({"--set", "initial.random_points=10", "--set", "stage2.epsilon1=0.3"}));
}

TEST_F(ReportAsConfig, WhatIsWrongInAReportIsNamed) {
  write_file(folder_ / "r.json", R"({"schema": "deliso-report-1", "components": 1, "parameters": {"field": 1}})");
  const ProgramResult result =
      run_deliso({"mesh", volume_, "--isovalue", "0.1", "-o", folder_ / "m.ply", "--config", folder_ / "r.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("parameters: field must be a JSON object, found 1"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace deliso::testing
