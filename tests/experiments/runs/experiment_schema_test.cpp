// The schema of experiments and their parser: what one takes or refuses for its form, the other does too.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "experiments/runs/experiment_keys.h"
#include "tests/support/json_schema.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

// What `deliso schema` prints, with the experiment on top.
const Json& schema() {
  static const Json kSchema = [] {
    const ProgramResult result = run_deliso({"schema"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return parse_json(result.out, "schema");
  }();
  return kSchema;
}

bool is_experiment(const Json& document) { return validates(schema()["$defs"]["experiment"], document, schema()); }

// How the parser sees a document.
enum class Judgement { kTaken, kBadForm, kBadSense };

// Form is what a schema can know: keys, types, ranges. Sense is the rest: names of nothing, contradictions.
Judgement judge(const Json& document, std::string& message) {
  try {
    parse_experiment(document, "full.json");
    return Judgement::kTaken;
  } catch (const InputError& error) {
    message = error.what();
  }
  for (const std::string sign : {" must be ", ": unknown key ", " is missing ("}) {
    if (message.find(sign) != std::string::npos) return Judgement::kBadForm;
  }
  return Judgement::kBadSense;
}

// An experiment in which every key is there that can be.
Json full_document() {
  Json document = small_document();
  document["name"] = "full";
  document["question"] = "Does it?";
  document["notes"] = Json::array({"A note."});
  document["task"] = "mesh";
  document["distances"] = true;
  document["builtin_datasets"] = Json::array({Json{{"name", "knot"}, {"field", "knot"}, {"seed", 3}, {"size", 12}}});
  document["datasets"].push_back(Json{{"name", "scan"},
                                      {"file", "scan.nrrd"},
                                      {"also", "scan.raw"},
                                      {"isovalue", 3.5},
                                      {"sha256", std::string(64, 'a')},
                                      {"get", "ask"}});
  document["base"]["set"] = Json{{"stage1.rho", 3}};
  document["variants"].push_back(Json{{"name", "cubes"}, {"mesher", "marching_cubes"}});
  document["variants"].push_back(Json{
      {"name", "other"},
      {"mesher",
       {{"command", {"sh", "{volume}", "{mesh}"}}, {"timeout", 3}, {"mesh_format", "off"}, {"exit_codes", {0, 1}}}}});
  document["sweep"] = Json{{"stage1.epsilon", {0.2, 0.3}}};
  document["seed"] = 5;
  document["rows"] = "runs";
  document["reference"] = Json{{"source", "a paper"}, {"rows", {{"ball", {{"n", 40}, {"verdict", "homeomorphic"}}}}}};
  document["metrics"][0]["reference"] = "n";
  document["metrics"][0]["ratio"] = true;
  document["metrics"][0]["variant"] = "fine stage1.epsilon=0.2";
  document["metrics"][1]["over"] = "fine stage1.epsilon=0.2";
  document["answers"] = parse_json(R"([
    {"text": "{ball|fine stage1.epsilon=0.2|vertices} are enough.",
     "holds": [{"figure": "ball|fine stage1.epsilon=0.2|vertices", "is": "above", "than": 4},
               {"figure": "ball|fine stage1.epsilon=0.2|verdict", "is": "equal", "than": "homeomorphic"}]}])",
                                   "answers");
  document["plots"] = parse_json(R"([
    {"name": "a", "title": "A", "kind": "curve", "x": "vertices", "y": ["share"], "log": ["x"], "across": "datasets",
     "series": [{"name": "all", "members": ["ball", "ring"]}]},
    {"name": "b", "title": "B", "kind": "bars", "y": ["vertices"], "share": true},
    {"name": "c", "title": "C", "kind": "histogram", "value": "quality.min_angle_histogram", "bin_width": 5,
     "x_label": "angle"}])",
                                 "plots");
  return document;
}

// Pointers to every value of a document, with those of keys that may come and go.
void collect(const Json& value, const Json::json_pointer& here, std::vector<Json::json_pointer>& all) {
  if (!here.empty()) all.push_back(here);
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) collect(inner, here / key, all);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], here / i, all);
  }
}

TEST(ExperimentSchema, TheFullDocumentNamesEveryKeyAndIsTaken) {
  const Json document = full_document();
  std::string message;
  EXPECT_EQ(judge(document, message), Judgement::kTaken) << message;
  EXPECT_TRUE(is_experiment(document));
  // So that the next test tries every key.
  const auto expect_all = [](const auto& keys, const Json& objects) {
    std::set<std::string> found;
    for (const Json& object : objects) {
      for (const auto& [key, value] : object.items()) found.insert(key);
    }
    for (const KeyInfo& key : keys) {
      EXPECT_TRUE(found.contains(std::string(key.name)) || key.name == "manifest") << key.name;
    }
  };
  expect_all(kExperimentKeys, Json::array({document}));
  Json datasets = document["datasets"];
  datasets.push_back(document["builtin_datasets"][0]);
  expect_all(kDatasetKeys, datasets);
  expect_all(kBaseKeys, Json::array({document["base"]}));
  expect_all(kVariantKeys, document["variants"]);
  expect_all(kCommandKeys, Json::array({document["variants"].back()["mesher"]}));
  expect_all(kMetricKeys, document["metrics"]);
  expect_all(kPlotKeys, document["plots"]);
  expect_all(kSeriesKeys, document["plots"][0]["series"]);
  expect_all(kAnswerKeys, document["answers"]);
  expect_all(kClaimKeys, document["answers"][0]["holds"]);
  expect_all(kReferenceKeys, Json::array({document["reference"]}));
}

TEST(ExperimentSchema, AgreesWithTheParserOnEveryPlaceAndProbe) {
  const std::vector<Json> probes = {nullptr,
                                    true,
                                    -1,
                                    0,
                                    1,
                                    2,
                                    1.5,
                                    1e300,
                                    "",
                                    "default",
                                    "runs",
                                    Json::array(),
                                    Json::object(),
                                    Json::array({1}),
                                    Json{{"stage1.epsilon", 0.3}},
                                    Json{{"no_key", 1}},
                                    Json::array({"vertices"})};
  const Json document = full_document();
  std::vector<Json::json_pointer> places;
  collect(document, Json::json_pointer(), places);
  int taken = 0;
  int refused = 0;
  const auto compare = [&](const Json& changed, const Json::json_pointer& place) {
    std::string message;
    const Judgement judgement = judge(changed, message);
    const bool valid = is_experiment(changed);
    EXPECT_TRUE(valid || judgement != Judgement::kTaken) << place << ' ' << changed[place];
    EXPECT_FALSE(valid && judgement == Judgement::kBadForm) << message;
    ++(valid ? taken : refused);
  };
  for (const Json::json_pointer& place : places) {
    for (const Json& probe : probes) {
      Json changed = document;
      changed[place] = probe;
      compare(changed, place);
    }
    Json without = document;
    Json& parent = without[place.parent_pointer()];
    if (parent.is_array()) {
      parent.erase(std::stoul(place.back()));
    } else {
      parent.erase(place.back());
    }
    compare(without, place.parent_pointer());
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 1000);
}

TEST(ExperimentSchema, EveryUnknownKeyIsRefusedByBoth) {
  const Json document = full_document();
  std::vector<Json::json_pointer> places;
  collect(document, Json::json_pointer(), places);
  places.emplace_back();
  int objects = 0;
  for (const Json::json_pointer& place : places) {
    // The rows of a reference are named by their data sets and columns.
    if (!document[place].is_object() || place.to_string().starts_with("/reference/rows")) continue;
    Json changed = document;
    changed[place]["no_such_key"] = 1;
    std::string message;
    EXPECT_EQ(judge(changed, message), Judgement::kBadForm) << place << ' ' << message;
    EXPECT_NE(message.find("no_such_key"), std::string::npos) << message;
    EXPECT_NE(message.find("nearest known key"), std::string::npos) << message;
    EXPECT_FALSE(is_experiment(changed)) << place;
    ++objects;
  }
  EXPECT_GT(objects, 15);
}

TEST(ExperimentSchema, EveryFileUnderConfigsValidates) {
  int experiments = 0;
  int parameters = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(DELISO_SOURCE_DIR) / "configs")) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path());
    // Beside them stand pages, and the sentences from which one of them is made.
    if (entry.path().extension() == ".md" || entry.path().filename() == "answers.txt") continue;
    EXPECT_EQ(entry.path().extension(), ".json");
    const Json document = read_json(entry.path());
    if (entry.path().parent_path().filename() == "reference") continue;
    if (document.contains("metrics")) {
      EXPECT_TRUE(is_experiment(document));
      ++experiments;
    } else {
      EXPECT_TRUE(validates(schema()["$defs"]["parameters"], document, schema()));
      ++parameters;
    }
  }
  EXPECT_GE(experiments, 25);
  EXPECT_GE(parameters, 3);
}

}  // namespace
}  // namespace deliso::testing
