// Experiments that grow: what `--resume` takes, what one config gets wrong all at once, own volumes, several runs at a
// time.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runs/record_file.h"
#include "tests/support/run_examples.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"

namespace deliso::testing {
namespace {

// One small field; a sweep of twelve values.
Json sweep_of_twelve() {
  Json document = small_document();
  document["datasets"] = Json::array({Json{{"name", "ball"}, {"field", "sphere"}, {"size", 6}}});
  document["base"]["parameters"]["certify"] = true;
  document.erase("variants");
  document["repeats"] = 1;
  Json& values = document["sweep"]["stage2.epsilon1"] = Json::array();
  for (int i = 0; i < 12; ++i) values.push_back(0.2 + 0.02 * i);
  document["metrics"] = Json::array(
      {Json{{"name", "vertices"}, {"value", "vertices"}}, Json{{"name", "seconds"}, {"value", "total_seconds"}}});
  return document;
}

class GrowingExperiment : public ::testing::Test {
 protected:
  ProgramResult run(const Json& document, const std::vector<std::string>& more, const std::string& name = "own.json") {
    write_file(folder_ / name, json_text(document));
    std::vector<std::string> arguments = {"run", folder_ / name, "--out", folder_ / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  std::vector<Json> records(const std::string& name = "records.jsonl") {
    std::vector<std::string> notes;
    return read_records(folder_ / ("out/" + name), notes);
  }
  std::size_t planned(const Json& document) {
    const ProgramResult plan = run(document, {"--resume", "--dry-run"});
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    return static_cast<std::size_t>(std::count(plan.out.begin(), plan.out.end(), '\n'));
  }

  TemporaryFolder folder_;
};

TEST_F(GrowingExperiment, OneMoreValueOfASweepMakesOneRun) {
  Json document = sweep_of_twelve();
  EXPECT_EQ(run(document, {}).exit_code, 0);
  const std::vector<Json> before = records();
  ASSERT_EQ(before.size(), 12U);
  document["sweep"]["stage2.epsilon1"].push_back(0.5);
  EXPECT_EQ(run(document, {}).exit_code, 2);  // not without --resume
  EXPECT_EQ(planned(document), 1U);
  const ProgramResult grown = run(document, {"--resume"});
  EXPECT_EQ(grown.exit_code, 0) << grown.err;
  const std::vector<Json> after = records();
  ASSERT_EQ(after.size(), 13U);
  // The twelve are the same to the last figure, their times included.
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  EXPECT_EQ(after.back()["parameters"]["stage2"]["epsilon1"], 0.5);
}

TEST_F(GrowingExperiment, NamesAndOrderDoNotMatterButWhatWasRunDoes) {
  Json document = sweep_of_twelve();
  run(document, {});
  // Other names of the experiment, the data set and the base, other words and columns, values in another order.
  document["name"] = "renamed";
  document["title"] = "Other words";
  document["datasets"][0]["name"] = "globe";
  document["base"]["name"] = "basis";
  Json& values = document["sweep"]["stage2.epsilon1"];
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(planned(document), 0U);
  EXPECT_EQ(run(document, {"--resume"}).exit_code, 0);
  for (const Json& record : records()) {
    EXPECT_EQ(record["experiment"], "renamed");
    EXPECT_EQ(record["dataset"], "globe");
    const std::string name = record["variant"];
    EXPECT_EQ(name, "basis stage2.epsilon1=" + record["parameters"]["stage2"]["epsilon1"].dump());
  }
  // A parameter, the seed, the isovalue or the samples differ: nothing holds.
  const auto changed = [&](const std::string& pointer, const Json& value) {
    Json other = document;
    other[Json::json_pointer(pointer)] = value;
    return planned(other);
  };
  EXPECT_EQ(changed("/base/parameters/stage1/epsilon", 0.19), 12U);
  EXPECT_EQ(changed("/seed", 2), 12U);
  EXPECT_EQ(changed("/datasets/0/isovalue", 0.31), 12U);
  EXPECT_EQ(changed("/datasets/0/size", 7), 12U);
  EXPECT_EQ(changed("/distances", true), 12U);  // measures that the records do not have
}

TEST_F(GrowingExperiment, WhatNoRunNeedsIsKeptForLater) {
  const Json document = sweep_of_twelve();
  run(document, {});
  Json fewer = document;
  fewer["sweep"]["stage2.epsilon1"].erase(3);
  EXPECT_EQ(run(fewer, {"--resume"}).exit_code, 0);
  EXPECT_EQ(records().size(), 11U);
  EXPECT_EQ(records("unused.jsonl").size(), 1U);
  EXPECT_EQ(planned(document), 0U);
  EXPECT_EQ(run(document, {"--resume"}).exit_code, 0);
  EXPECT_EQ(records().size(), 12U);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/unused.jsonl"));
}

TEST_F(GrowingExperiment, RecordsOfAnotherProgramAreNotTaken) {
  const Json document = sweep_of_twelve();
  run(document, {});
  std::string text;
  for (Json record : records()) {
    if (record["variant"].get<std::string>().ends_with("0.2")) record["program"]["commit"] = "0123456789ab";
    record["program"]["cpu"] = "another machine";
    text += record.dump() + "\n";
  }
  write_file(folder_ / "out/records.jsonl", text);
  EXPECT_EQ(planned(document), 1U);
}

TEST_F(GrowingExperiment, AllMistakesOfAConfigAreToldAtOnceWithTheirLines) {
  write_file(folder_ / "six.json", R"({
  "title": "Six",
  "datasets": [
    {"name": "ball", "field": "sphere", "size": 8},
    {"name": "own", "file": "mine.nrrd"}
  ],
  "base": {"name": "default", "parameters": {"stage1": {"epsilon": -1}}},
  "variants": [
    {"name": "fine", "set": {"stage2.epsilom1": 0.1}},
    {"name": "coarse", "extends": "fien"}
  ],
  "repeat": 3,
  "metrics": [
    {"name": "vertices", "value": "vertice"},
    {"name": "share", "value": "vertices", "over": "coarse"}
  ]
})");
  const ProgramResult result = run_deliso({"run", folder_ / "six.json", "--out", folder_ / "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  const std::string file = "deliso: " + (folder_ / "six.json");
  EXPECT_EQ(result.err,
            file + " (line 12): unknown key 'repeat', the nearest known key is 'repeats'\n" +  //
                file + "#/datasets/1/isovalue (line 5) is required for a file\n" +             //
                file + "#/base/parameters (line 7): stage1.epsilon must be a number > 0, found -1\n" + file +
                "#/variants/0/set (line 9): unknown key 'stage2.epsilom1', the nearest known key is " +
                "'stage2.epsilon1'\n" +  //
                file + "#/variants/1/extends (line 10) names no variant: 'fien', the nearest is 'fine'\n" + file +
                "#/metrics/0/value (line 14) names no figure of a record: 'vertice', the nearest is " + "'vertices'\n");
}

// So do parameters.
TEST_F(GrowingExperiment, AllMistakesOfParametersAreToldAtOnce) {
  write_file(folder_ / "p.json", "{\n\"stage1\": {\"epsilon\": 0, \"rh\": 2},\n\"certify\": 1}");
  write_volume(generate_field("sphere", 6, 1), folder_ / "v.nrrd");
  const ProgramResult result = run_deliso(
      {"mesh", folder_ / "v.nrrd", "--isovalue", "0.3", "--config", folder_ / "p.json", "-o", folder_ / "m.ply"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
}

TEST_F(GrowingExperiment, OwnVolumesNeedNoHintHowToGetThem) {
  std::filesystem::create_directories(folder_ / "data");
  write_volume(generate_field("sphere", 6, 1), folder_ / "data/mine.nrrd");
  Json document = sweep_of_twelve();
  document.erase("sweep");
  document["datasets"] = Json::array({Json{{"name", "mine"}, {"file", "mine.nrrd"}, {"isovalue", 0.3}},
                                      Json{{"name", "gone"}, {"file", "gone.nrrd"}, {"isovalue", 0.3}}});
  const ProgramResult result = run(document, {"--data", folder_ / "data"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "deliso: absent: gone: gone.nrrd is not in " + (folder_ / "data") +
                            "; put it there, or name its folder with --data\n");
  EXPECT_EQ(planned(document), 1U);  // the absent one
  // Another file of the same name is another volume.
  write_volume(generate_field("torus", 6, 1), folder_ / "data/mine.nrrd");
  const ProgramResult plan = run(document, {"--data", folder_ / "data", "--resume", "--dry-run"});
  EXPECT_EQ(std::count(plan.out.begin(), plan.out.end(), '\n'), 2) << plan.out;
}

TEST_F(GrowingExperiment, SeveralRunsAtATimeGiveTheSameMeshesAndSayThatTimesAreShared) {
  const Json document = sweep_of_twelve();
  const ProgramResult alone = run(document, {});
  std::vector<Json> expected = records();
  EXPECT_EQ(alone.out.find("Shared times"), std::string::npos);
  std::filesystem::remove_all(folder_ / "out");
  const ProgramResult together = run(document, {"--jobs", "3"});
  EXPECT_EQ(together.exit_code, 0) << together.err;
  std::vector<Json> found = records();
  ASSERT_EQ(found.size(), expected.size());
  const auto by_variant = [](const Json& a, const Json& b) { return a["variant"].dump() < b["variant"].dump(); };
  std::sort(found.begin(), found.end(), by_variant);
  std::sort(expected.begin(), expected.end(), by_variant);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i]["quality"], expected[i]["quality"]);
    EXPECT_EQ(found[i]["runs_at_a_time"], 3);
    EXPECT_EQ(expected[i]["runs_at_a_time"], 1);
  }
  EXPECT_NE(together.out.find("| seconds* |"), std::string::npos) << together.out;
  EXPECT_NE(together.out.find("\\* Shared times: up to 3 runs"), std::string::npos);
}

TEST_F(GrowingExperiment, EveryTableMarksTimesThatAreSharedOrOfDifferentThreads) {
  Json document = sweep_of_twelve();
  Json& values = document["sweep"]["stage2.epsilon1"] = Json::array({0.2});
  document["metrics"].push_back(Json{{"name", "rate"}, {"value", "vertices"}, {"per", "total_seconds"}});
  const ProgramResult first = run(document, {"--jobs", "2", "--threads", "1"});
  EXPECT_NE(first.out.find("| vertices | seconds* | rate* |"), std::string::npos) << first.out;
  EXPECT_EQ(first.out.find("numbers of threads"), std::string::npos);
  const std::string latex = read_file(folder_ / "out/table.tex");
  EXPECT_NE(latex.find("vertices & seconds* & rate* "), std::string::npos) << latex;
  EXPECT_NE(latex.find("\\multicolumn{4}{l}{* Shared times: up to 2 runs"), std::string::npos) << latex;
  // One more run, with other threads.
  values.push_back(0.3);
  const std::string note = "Times of runs with different numbers of threads: 1 and 2.";
  const ProgramResult more = run(document, {"--threads", "2", "--resume"});
  EXPECT_NE(more.out.find("\n" + note + "\n"), std::string::npos) << more.out << more.err;
  EXPECT_NE(read_file(folder_ / "out/table.tex").find(note), std::string::npos);
  EXPECT_EQ(read_json(folder_ / "out/table.json")["threads"], Json::array({1, 2}));
}

TEST_F(GrowingExperiment, FailedRunsAmongSeveralAreToldAndTheOthersMade) {
  std::filesystem::create_directories(folder_ / "data");
  write_file(folder_ / "data/broken.nrrd", "NRRD0004\n");
  Json document = sweep_of_twelve();
  document["datasets"].push_back(Json{{"name", "broken"}, {"file", "broken.nrrd"}, {"isovalue", 0.3}});
  const ProgramResult result = run(document, {"--jobs", "2", "--data", folder_ / "data"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 12) << result.err;
  EXPECT_EQ(records().size(), 24U);
}

}  // namespace
}  // namespace deliso::testing
