// A report, a record or an experiment where parameters are expected.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "tests/support/temporary_folder.h"

namespace deliso {
namespace {

// What reading the text as a file of parameters gives, or the refusal.
Json read_as_config(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "document.json";
  std::ofstream(path) << text;
  try {
    return parameters_to_json(read_parameters(path));
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(WholeDocument, TheParametersOfAReportAreTaken) {
  Parameters changed;
  set_parameter("stage2.epsilon1=0.05", changed);
  set_parameter("boundary=closed", changed);
  const Json parameters = parameters_to_json(changed);
  EXPECT_EQ(read_as_config(Json{{"schema", "deliso-report-1"}, {"seed", 3}, {"parameters", parameters}}.dump()),
            parameters);
  EXPECT_EQ(read_as_config(Json{{"parameters", parameters}}.dump()), parameters);
  EXPECT_EQ(read_as_config(parameters.dump()), parameters);
  // Results that are called like groups of parameters, beside a schema of ours.
  Json report{{"components", 2}, {"field", {{"label", nullptr}, {"nan", "refuse"}}}, {"parameters", parameters}};
  for (const char* schema : {"deliso-report-1", "deliso-record-1"}) {
    report["schema"] = schema;
    EXPECT_EQ(read_as_config(report.dump()), parameters) << schema;
  }
}

TEST(WholeDocument, WhatIsWrongInsideIsNamedThere) {
  const std::string wrong = read_as_config(R"({"parameters": {"stage1": {"epsilon": -1}}})").get<std::string>();
  EXPECT_NE(wrong.find(": parameters: stage1.epsilon must be"), std::string::npos) << wrong;
  // Both at once say nothing clear.
  const std::string both = read_as_config(R"({"parameters": {}, "stage1": {"epsilon": 0.1}})").get<std::string>();
  EXPECT_NE(both.find("unknown key 'parameters'"), std::string::npos) << both;
  const std::string experiment = read_as_config(R"({"name": "x", "base": {"parameters": {}}})").get<std::string>();
  EXPECT_NE(experiment.find("this is an experiment"), std::string::npos) << experiment;
}

}  // namespace
}  // namespace deliso
