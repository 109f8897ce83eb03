// Experiments as JSON: what is taken, what is refused and how, and that every experiment of the project is sound.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "experiments/runs/metric.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

// The message with which the document is refused; empty when it is taken.
std::string refusal(const Json& document) {
  try {
    parse_experiment(document, "small.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The refusal of the small experiment with the value at a JSON pointer replaced.
std::string refusal_with(const std::string& pointer, const Json& value) {
  Json document = small_document();
  document[Json::json_pointer(pointer)] = value;
  return refusal(document);
}

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(RunConfig, SmallExperimentIsTaken) {
  const Experiment experiment = small_experiment();
  EXPECT_EQ(experiment.name, "small");
  ASSERT_EQ(experiment.datasets.size(), 2u);
  EXPECT_EQ(experiment.datasets[0].isovalue, 0.3);  // the field's own
  ASSERT_EQ(experiment.variants.size(), 2u);
  EXPECT_EQ(experiment.variants[1].parameters.stage2.epsilon1, 0.3);
  EXPECT_EQ(experiment.variants[1].parameters.initial.random_points, 10);
  EXPECT_EQ(planned_runs(experiment).size(), 12u);
}

// What walks through a document calls itself for each level: the stack would end before the document.
TEST(RunConfig, WhatIsNestedTooDeeplyIsRefusedInOneSentence) {
  const TemporaryFolder folder;
  const auto nested = [](const std::string& open, const std::string& close, int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += open;
    text += "1";
    for (int i = 0; i < levels; ++i) text += close;
    return text;
  };
  for (const std::string& text : {nested("{\"a\": ", "}", 60000), nested("[", "]", 60000), nested("[", "]", 501)}) {
    write_file(folder / "deep.json", text);
    const ProgramResult result = run_deliso({"run", folder / "deep.json"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "deliso: " + (folder / "deep.json") +
                              ": nested too deeply, expected at most 500 objects and arrays within each other\n");
  }
  EXPECT_NO_THROW(parse_json(nested("[", "]", 500), "p.json"));
}

TEST(RunConfig, ParametersThatContradictEachOtherAreFoundBeforeTheFirstRun) {
  const std::string contradict = "contradict each other: stage2.pole_height: repair takes the nearer pole";
  const Json set = Json{{"stage2.pole_height", "mean"}};
  EXPECT_MESSAGE(refusal_with("/variants/1/set", set),
                 "small.json#/variants: the parameters of 'coarse' " + contradict);
  EXPECT_MESSAGE(refusal_with("/sweep", Json{{"stage2.pole_height", {"nearer", "mean"}}}),
                 "small.json#/variants: the parameters of 'coarse stage2.pole_height=mean' " + contradict);
  Json document = small_document();
  document["base"]["set"] = set;
  document["variants"][1].erase("set");
  for (Json& variant : document["variants"]) variant["mesher"] = "marching_cubes";  // which does not read them
  EXPECT_EQ(refusal(document), "");
}

// The name is that of a folder for results: it must not lead out of the one it is put into.
TEST(RunConfig, NamesThatLeadElsewhereAreRefused) {
  for (const std::string name : {"../../zz", "..", "/tmp/zz", "a/b", ".hidden"}) {
    EXPECT_EQ(refusal_with("/name", name),
              "small.json#/name becomes the name of a folder: no '/' in it and no '.' before it, not '" + name + "'");
  }
  EXPECT_EQ(refusal_with("/name", "table 3, v1.2"), "");
}

TEST(RunConfig, MisspeltKeysNameThePlaceAndTheNearestKey) {
  EXPECT_EQ(refusal_with("/repeat", 3), "small.json: unknown key 'repeat', the nearest known key is 'repeats'");
  EXPECT_EQ(refusal_with("/variants/1/extend", "fine"),
            "small.json#/variants/1: unknown key 'extend', the nearest known key is 'extends'");
  EXPECT_EQ(refusal_with("/datasets/0/isovalu", 1),
            "small.json#/datasets/0: unknown key 'isovalu', the nearest known key is 'isovalue'");
  EXPECT_EQ(refusal_with("/metrics/0/values", 1),
            "small.json#/metrics/0: unknown key 'values', the nearest known key is 'value'");
  EXPECT_EQ(refusal_with("/variants/1/set", Json{{"stage2.epsilon_1", 0.3}}),
            "small.json#/variants/1/set: unknown key 'stage2.epsilon_1', the nearest known key is 'stage2.epsilon1'");
  EXPECT_MESSAGE(refusal_with("/base/parameters", Json{{"stage2", {{"epsilom", 1}}}}), "'stage2.epsilom'");
}

TEST(RunConfig, NamesOfNothingNameTheNearest) {
  EXPECT_MESSAGE(refusal_with("/metrics/0/value", "stages.recover.insertion"),
                 "small.json#/metrics/0/value names no figure of a record: 'stages.recover.insertion', the nearest is "
                 "'stages.recover.insertions'");
  EXPECT_MESSAGE(refusal_with("/metrics/1/over", "fin"),
                 "#/metrics/1/over names no variant: 'fin', the nearest is 'fine'");
  EXPECT_MESSAGE(refusal_with("/variants/1/extends", "defualt"), "the nearest is 'default'");
  EXPECT_MESSAGE(refusal_with("/datasets/0/field", "spere"), "small.json#/datasets/0/field: there is no ");
  EXPECT_MESSAGE(refusal_with("/datasets/0/field", "spere"), "sphere");
  EXPECT_MESSAGE(refusal_with("/datasets/0", "FUEL"), "#/datasets/0: the manifest has no data set 'FUEL'");
}

// A figure that records can hold, but not those of this experiment.
TEST(RunConfig, FiguresOfDistancesSayWhatTheyNeed) {
  const std::string path = "distances.mesh_to_isosurface_max_voxels";
  EXPECT_EQ(refusal_with("/metrics/0/value", path),
            "small.json#/metrics/0/value needs \"distances\": true in the experiment: '" + path +
                "' is a figure of its records only then");
  Json document = small_document();
  document["distances"] = true;
  document["metrics"][0]["value"] = path;
  EXPECT_EQ(refusal(document), "");
  document["distances"] = false;
  document["task"] = "topology";
  EXPECT_MESSAGE(refusal(document), "names no figure of a record");
}

TEST(RunConfig, WrongTypesAndRangesNameThePlace) {
  EXPECT_EQ(refusal(7), "small.json must be an object, found 7");
  EXPECT_EQ(refusal_with("/repeats", 0), "small.json#/repeats must be an integer from 1 to 10000, found 0");
  EXPECT_MESSAGE(refusal_with("/repeats", 1.5), "#/repeats must be an integer");
  EXPECT_MESSAGE(refusal_with("/repeats", "3"), "#/repeats must be an integer");
  EXPECT_MESSAGE(refusal_with("/datasets", Json::array()), "#/datasets must be an array that is not empty");
  EXPECT_MESSAGE(refusal_with("/datasets/1", 7), "#/datasets/1 must be an object, found 7");
  EXPECT_MESSAGE(refusal_with("/datasets/0/size", 1), "#/datasets/0/size must be an integer from 2 to 2048, found 1");
  EXPECT_MESSAGE(refusal_with("/rows", "columns"), "#/rows must be one of 'runs', 'datasets', found \"columns\"");
  EXPECT_MESSAGE(refusal_with("/variants/1/set", Json{{"stage1.rho", 0.5}}), "stage1.rho must be a number >= 1");
  EXPECT_MESSAGE(refusal_with("/sweep", Json{{"stage1.rho", 2}}), "#/sweep/stage1.rho must be a list");
  EXPECT_MESSAGE(refusal_with("/sweep", Json{{"stage1.rho", {2, 2}}}), "has the value 2 twice");
  Json document = small_document();
  document.erase("metrics");
  EXPECT_MESSAGE(refusal(document), "small.json: the key 'metrics' is missing");
}

TEST(RunConfig, ContradictionsAreRefused) {
  EXPECT_MESSAGE(refusal_with("/datasets/0/file", "a.nrrd"), "either the key 'file' or the key 'field'");
  EXPECT_MESSAGE(refusal_with("/datasets/1/name", "ball"), "the name of two data sets");
  EXPECT_MESSAGE(refusal_with("/variants/1/name", "fine"), "the name of two variants");
  EXPECT_MESSAGE(refusal_with("/metrics/1/name", "vertices"), "heads two columns");
  EXPECT_MESSAGE(refusal_with("/metrics/0/ratio", true), "needs a reference");
  EXPECT_MESSAGE(refusal_with("/rows", "datasets"), "#/metrics/0/variant is needed");
  EXPECT_MESSAGE(refusal_with("/datasets/0",
                              Json{{"name", "a"}, {"file", "a.nrrd"}, {"isovalue", 1}, {"get", "x"}, {"sha256", "12"}}),
                 "64 lower-case hexadecimal digits");
}

TEST(RunConfig, WhatAVariantSetsWithoutEffectIsRefused) {
  Json document = small_document();
  document["variants"][1]["set"] = {{"stage2.epsilon1", 0.3}};
  document["sweep"] = {{"stage2.epsilon1", {0.1, 0.2}}};
  EXPECT_MESSAGE(refusal(document), "#/variants/1/set/stage2.epsilon1 has no effect: the sweep");
  document["sweep"] = {{"stage2.epsilon2", {0.1, 0.2}}};
  document["metrics"][1].erase("over");
  EXPECT_EQ(refusal(document), "");

  document["variants"][1]["mesher"] = "marching_cubes";
  EXPECT_MESSAGE(refusal(document), "#/variants/1/set/stage2.epsilon1 has no effect: the mesher");
  document["variants"][1]["set"] = {{"boundary", "closed"}, {"certify", false}, {"spacing", "ignore"}};
  EXPECT_EQ(refusal(document), "");
  document["variants"][1]["mesher"] = {{"command", {"mesher"}}};
  EXPECT_MESSAGE(refusal(document), "#/variants/1/set/certify has no effect: the mesher");
}

// What another mesher does not read is that of the base, so that the experiment can be read back.
TEST(RunConfig, OtherMeshersTakeOfAnotherVariantWhatTheyRead) {
  Json document = small_document();
  document["variants"][1]["set"] = {{"stage2.epsilon1", 0.3}, {"boundary", "closed"}};
  document["variants"].push_back({{"name", "cubes"}, {"extends", "coarse"}, {"mesher", "marching_cubes"}});
  document["sweep"] = {{"stage2.epsilon2", {0.1, 0.2}}};
  document["metrics"][1].erase("over");
  const Experiment experiment = parse_experiment(document, "small.json");
  const Parameters& cubes = experiment.variants.back().parameters;
  EXPECT_EQ(cubes.boundary, Boundary::kClosed);
  EXPECT_EQ(cubes.stage2.epsilon1, experiment.base.parameters.stage2.epsilon1);
  EXPECT_EQ(refusal(experiment_to_json(experiment)), "");
}

TEST(RunConfig, QuotientsNeedNumbers) {
  EXPECT_MESSAGE(refusal_with("/metrics/1/value", "certificate.verdict"), "#/metrics/1/value is no number");
  EXPECT_MESSAGE(refusal_with("/metrics/0/per", "volume.dims"), "#/metrics/0/per is no number");
}

TEST(RunConfig, SweepsAreCartesian) {
  Json document = small_document();
  document["sweep"] = Json{{"stage1.epsilon", {0.1, 0.2, 0.3}}, {"queue_order", {"fifo", "worst_first"}}};
  document["metrics"][1].erase("over");
  const Experiment experiment = parse_experiment(document, "small.json");
  std::set<std::string> names;
  std::set<std::string> settings;
  for (const Variant& variant : experiment.variants) {
    names.insert(variant.name);
    settings.insert(parameters_to_json(variant.parameters).dump());
  }
  EXPECT_EQ(experiment.variants.size(), 12u);
  EXPECT_EQ(names.size(), 12u);
  EXPECT_EQ(settings.size(), 12u);
  EXPECT_TRUE(names.contains("coarse stage1.epsilon=0.2 queue_order=fifo"));
}

TEST(RunConfig, ShardsPartitionTheRuns) {
  const Experiment experiment = small_experiment();
  for (std::uint64_t count = 1; count <= 15; ++count) {
    std::multiset<std::string> seen;
    for (std::uint64_t index = 1; index <= count; ++index) {
      for (const PlannedRun& run : runs_of(experiment, {index, count})) {
        seen.insert(std::to_string(run.dataset) + "." + std::to_string(run.variant) + "." + std::to_string(run.repeat));
      }
    }
    EXPECT_EQ(seen.size(), 12u) << count;
    EXPECT_EQ(std::set<std::string>(seen.begin(), seen.end()).size(), 12u) << count;
  }
}

// Every experiment under configs/; what has no data sets is a file of parameters or a reference.
std::vector<fs::path> experiments_of_the_project() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(DELISO_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".json" || entry.path().parent_path().filename() == "reference") continue;
    if (read_json(entry.path()).contains("metrics")) files.push_back(entry.path());
  }
  return files;
}

TEST(RunConfig, EveryExperimentOfTheProjectParsesAndReadsBackAsItWasWritten) {
  const std::vector<fs::path> files = experiments_of_the_project();
  EXPECT_GE(files.size(), 20u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const Experiment experiment = read_experiment(file);
    const Json written = experiment_to_json(experiment);
    EXPECT_EQ(experiment_to_json(parse_experiment(written, "elsewhere/experiment.json")), written);
    // Each has a form that needs no download.
    bool needs_files = false;
    for (const Dataset& dataset : experiment.datasets) needs_files = needs_files || !dataset.file.empty();
    EXPECT_TRUE(!needs_files || !experiment.builtin_datasets.empty());
  }
}

TEST(RunConfig, EveryAblationAsksAQuestion) {
  for (const fs::path& file : experiments_of_the_project()) {
    const Experiment experiment = read_experiment(file);
    if (file.parent_path().filename() != "ablation") continue;
    SCOPED_TRACE(file);
    EXPECT_NE(experiment.question.find('?'), std::string::npos);
    EXPECT_GE(experiment.variants.size(), 2u);
  }
}

// Distances from the surface can be taken from two kinds of points: a heading tells which.
TEST(RunConfig, AHeadingStandsForOneMeasureOfDistance) {
  std::map<std::string, std::string> value_of;
  for (const fs::path& file : experiments_of_the_project()) {
    for (const Metric& metric : read_experiment(file).metrics) {
      if (!metric.value.starts_with("distances.")) continue;
      EXPECT_EQ(value_of.try_emplace(metric.name, metric.value).first->second, metric.value) << file << metric.name;
    }
  }
  EXPECT_GE(value_of.size(), 5u);
}

TEST(RunConfig, EveryExperimentOfTheProjectRunsInItsSmokeForm) {
  for (const fs::path& file : experiments_of_the_project()) {
    SCOPED_TRACE(file);
    const TemporaryFolder folder;
    const ProgramResult result = run_deliso({"run", file.string(), "--smoke", "--out", folder / "out"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const Experiment experiment = read_experiment(file);
    for (const Metric& metric : experiment.metrics) EXPECT_MESSAGE(result.out, metric.name);
    EXPECT_EQ(result.out.find(", paper"), std::string::npos);  // nothing was published about the tiny field
    for (const Plot& plot : experiment.plots)
      EXPECT_TRUE(fs::exists(folder / ("out/" + plot.name + ".svg"))) << plot.name;
    const Json table = read_json(folder / "out/table.json");
    for (const Json& row : table["rows"]) EXPECT_EQ(row["state"], "done");
  }
}

TEST(RunConfig, EveryFileOfParametersMeshesATinySphere) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_deliso({"generate", "sphere", "--size", "8", "-o", folder / "sphere.nrrd"}).exit_code, 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(DELISO_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".json" || entry.path().parent_path().filename() == "reference") continue;
    if (read_json(entry.path()).contains("metrics")) continue;
    SCOPED_TRACE(entry.path());
    const ProgramResult result = run_deliso({"mesh", folder / "sphere.nrrd", "--isovalue", "0.3", "--config",
                                             entry.path().string(), "-o", folder / "sphere.ply"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    ++files;
  }
  EXPECT_GE(files, 3);
}

}  // namespace
}  // namespace deliso::testing
