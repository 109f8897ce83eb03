// Parameters as JSON: defaults, round trips and refusals.
#include "experiments/config/config.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "surface/base/parameter_table.h"

namespace deliso {
namespace {

// The message with which `text` is refused; empty when it is taken.
std::string refusal(const std::string& text) {
  try {
    Parameters parameters;
    apply_parameters(parse_json(text, "p.json"), "p.json", parameters);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string set_refusal(const std::string& assignment) {
  try {
    Parameters parameters;
    set_parameter(assignment, parameters);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Written out from the documentation, not from the code.
constexpr const char* kDocumentedDefaults = R"({
  "algorithm": "two_stage",
  "initial": {"random_points": 0, "seeding": "components"},
  "stage1": {"epsilon": 0.2, "rho": 2.0, "r_min": 0.001, "size_bound_voxels": 0.3, "coverage": true,
             "one_sign_per_tetrahedron": true},
  "stage2": {"epsilon1": 0.1, "epsilon2": 0.2, "rho": 2.0, "r_min": 0.001, "max_distance": null, "h_min": null,
             "criterion2": "circumradius", "new_pole": "mean", "store_hits": true, "pole_height": "nearer"},
  "r_min_of": "voxels",
  "queue_order": "worst_first",
  "field": {"label": null, "smooth": null, "invert": false},
  "boundary": "open",
  "search": {"solver": "bracketed", "min_max_pruning": true, "leaf_cells": 1, "incremental": true,
             "traversal": "cell_walk"},
  "spacing": "use",
  "certify": true,
  "shape": {"min_angle": null, "smoothing": 1, "rounds": 4},
  "promise": {"max_distance": 1.0},
  "size": {"max_error": null, "max_edge": null, "min_angle": null, "max_aspect": null, "target_vertices": null},
  "components": {"fill_cavities": false, "min_vertices": null, "min_area": null, "min_volume": null,
                 "keep_largest": null},
  "region": {"i0": null, "i1": null, "j0": null, "j1": null, "k0": null, "k1": null},
  "repair": {"max_rounds": 8},
  "budget": {"seconds": null, "max_vertices": null}
})";

// A value in range that differs from run to run.
Json random_value(const ParameterField& field, Rng& rng) {
  if (field.nullable && rng.below(3) == 0) return nullptr;
  switch (field.type) {
    case ParameterType::kBoolean:
      return rng.below(2) == 0;
    case ParameterType::kChoice:
      return std::string(field.choices[rng.below(field.choices.size())]);
    case ParameterType::kInteger:
      return static_cast<std::int64_t>(field.range.low) + static_cast<std::int64_t>(rng.below(1000));
    case ParameterType::kNumber:
      return field.range.low + rng.uniform(1e-6, 10);
  }
  return nullptr;
}

TEST(Config, DefaultsAreTheDocumentedOnes) {
  EXPECT_EQ(parameters_to_json(Parameters{}), parse_json(kDocumentedDefaults, "documented"));
}

TEST(Config, DocumentedDefaultsParse) { EXPECT_EQ(refusal(kDocumentedDefaults), ""); }

TEST(Config, WritingAndParsingAreInverse) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Json document = parameters_to_json(Parameters{});
    for (const ParameterField& field : parameter_table()) {
      Json& object = group_of(field.path).empty() ? document : document[std::string(group_of(field.path))];
      object[std::string(key_of(field.path))] = random_value(field, rng);
    }
    Parameters parameters;
    apply_parameters(parse_json(json_text(document), "random"), "random", parameters);
    EXPECT_EQ(parameters_to_json(parameters), document) << "seed " << seed;
  }
}

TEST(Config, EveryFieldReachesItsOwnMember) {
  // Setting one key changes that key of the written document and no other.
  for (const ParameterField& field : parameter_table()) {
    Rng rng(7);
    Json expected = parameters_to_json(Parameters{});
    Json& slot = group_of(field.path).empty()
                     ? expected[std::string(field.path)]
                     : expected[std::string(group_of(field.path))][std::string(key_of(field.path))];
    const Json before = slot;
    while (slot == before) slot = random_value(field, rng);
    Parameters parameters;
    set_parameter(std::string(field.path) + "=" + slot.dump(), parameters);
    EXPECT_EQ(parameters_to_json(parameters), expected) << field.path;
  }
}

TEST(Config, KeysLeftOutKeepTheirValue) {
  Parameters parameters;
  parameters.stage2.rho = 3;
  apply_parameters(parse_json(R"({"stage2": {"epsilon1": 0.3}})", "p.json"), "p.json", parameters);
  EXPECT_EQ(parameters.stage2.rho, 3);
  EXPECT_EQ(parameters.stage2.epsilon1, 0.3);
}

TEST(Config, UnknownKeysNameThePathAndTheNearestKey) {
  EXPECT_EQ(refusal(R"({"stage1": {"epsilom": 0.2}})"),
            "p.json: unknown key 'stage1.epsilom', the nearest known key is 'stage1.epsilon'");
  EXPECT_TRUE(contains(refusal(R"({"stag2": {"rho": 2}})"), "nearest known key is 'stage2'"));
  EXPECT_TRUE(contains(refusal(R"({"certfy": true})"), "nearest known key is 'certify'"));
  EXPECT_TRUE(contains(refusal(R"({"solver": "schwarze"})"), "nearest known key is 'search.solver'"));
  // A key of the same group comes first, unless it is another word and another group has this one.
  EXPECT_TRUE(contains(refusal(R"({"stage2": {"epsilon": 0.2}})"), "nearest known key is 'stage2.epsilon1'"));
  EXPECT_TRUE(contains(refusal(R"({"stage2": {"coverage": true}})"), "nearest known key is 'stage1.coverage'"));
}

TEST(Config, PathsAsKeysOfAFileAreShownNested) {
  EXPECT_EQ(refusal(R"({"stage1.epsilon": 0.2})"),
            "p.json: the keys of a file are nested, expected {\"stage1\": {\"epsilon\": 0.2}}, found the key "
            "'stage1.epsilon'");
}

TEST(Config, WrongTypesAreRefused) {
  EXPECT_EQ(refusal(R"({"stage1": {"epsilon": "small"}})"),
            "p.json: stage1.epsilon must be a number > 0, found \"small\"");
  EXPECT_TRUE(contains(refusal(R"({"certify": 1})"), "certify must be true or false"));
  EXPECT_TRUE(contains(refusal(R"({"stage1": 3})"), "stage1 must be a JSON object"));
  EXPECT_TRUE(contains(refusal(R"({"search": {"leaf_cells": 1.5}})"), "an integer >= 1"));
  EXPECT_TRUE(contains(refusal(R"({"stage1": {"epsilon": null}})"), "a number > 0"));
  EXPECT_TRUE(contains(refusal(R"({"boundary": "opened"})"), "one of 'open', 'closed'"));
  EXPECT_TRUE(contains(refusal(R"([])"), "must be a JSON object"));
}

TEST(Config, ValuesOutOfRangeNameTheRange) {
  EXPECT_TRUE(contains(refusal(R"({"stage1": {"epsilon": 0}})"), "a number > 0, found 0"));
  EXPECT_TRUE(contains(refusal(R"({"stage2": {"rho": 0.99}})"), "a number >= 1"));
  EXPECT_TRUE(contains(refusal(R"({"stage2": {"r_min": -1e-300}})"), "a number >= 0"));
  // A bound that is no whole number, wherever it is told.
  EXPECT_TRUE(contains(refusal(R"({"size": {"max_error": 0}})"), "must be a number >= 1e-6 or null, found 0"));
  EXPECT_TRUE(contains(refusal(R"({"promise": {"max_distance": 1e-9}})"), "must be a number >= 1e-6, found 1e-09"));
  EXPECT_EQ(refusal(R"({"promise": {"max_distance": 1e-6}})"), "");
  EXPECT_TRUE(contains(parameters_help(), "[voxels]; a number >= 1e-6 or null"));
  EXPECT_EQ(parameters_schema()["properties"]["size"]["properties"]["max_error"]["minimum"], 1e-6);
  EXPECT_TRUE(contains(refusal(R"({"repair": {"max_rounds": 2147483648}})"), "<= 2147483647"));
  EXPECT_TRUE(contains(refusal(R"({"repair": {"max_rounds": 18446744073709551616}})"), "<= 2147483647"));
  EXPECT_TRUE(contains(refusal(R"({"budget": {"max_vertices": 3}})"), "an integer >= 4"));
}

// Read as a double the first one too many is the last one that is allowed.
TEST(Config, IntegersThatDoublesDoNotTellApartAreRefused) {
  EXPECT_EQ(refusal(R"({"budget": {"max_vertices": 9007199254740992}})"), "");
  for (const std::string number : {"9007199254740993", "18446744073709551615", "-9007199254740993"}) {
    EXPECT_NE(refusal(R"({"budget": {"max_vertices": )" + number + "}}"), "") << number;
  }
}

TEST(Config, OnlyStrictJsonIsTaken) {
  EXPECT_TRUE(contains(refusal(R"({"certify": true} // yes)"), "not valid JSON"));
  EXPECT_TRUE(contains(refusal(R"({"stage1": {"epsilon": NaN}})"), "line 1, column"));
  EXPECT_EQ(refusal("{\"stage1\":\n {\"epsilon\": 1e999}}"), "p.json: line 2: the number 1e999 is too large");
  EXPECT_TRUE(contains(refusal(R"({"certify": true,})"), "not valid JSON"));
  EXPECT_TRUE(contains(refusal(R"({"certify": true, "certify": false})"), "'certify' stands twice"));
  EXPECT_TRUE(contains(refusal(R"({"stage1": {"rho": 2}, "stage2": {"rho": 2, "rho": 3}})"), "'rho' stands twice"));
  EXPECT_EQ(refusal("{\"stage1\": {\"rho\": 2},\n\"stage2\": {\"rho\": 2,\n\"rho\": 3}}"),
            "p.json#/stage2/rho (line 3): the key 'rho' stands twice in one object");
  EXPECT_EQ(refusal(R"({"stage1": {"rho": 2}, "stage2": {"rho": 2}})"), "");
  EXPECT_TRUE(contains(refusal(""), "not valid JSON"));
  EXPECT_EQ(refusal(std::string("{}\n\0garbage", 11)), "p.json: not valid JSON, line 2 holds a byte of value 0");
}

TEST(Config, SetTakesPathsAndValues) {
  Parameters parameters;
  set_parameter("boundary=closed", parameters);
  set_parameter("queue_order=\"fifo\"", parameters);
  set_parameter("budget.seconds=1.5", parameters);
  set_parameter("stage1.rho=3", parameters);
  EXPECT_EQ(parameters.boundary, Boundary::kClosed);
  EXPECT_EQ(parameters.queue_order, QueueOrder::kFirstInFirstOut);
  EXPECT_EQ(parameters.budget.seconds, 1.5);
  EXPECT_EQ(parameters.stage1.rho, 3);
  // As other options take numbers, and JSON does not.
  set_parameter("budget.seconds=.25", parameters);
  set_parameter("stage1.rho=+4", parameters);
  set_parameter("shape.rounds=02.", parameters);
  EXPECT_EQ(parameters.budget.seconds, 0.25);
  EXPECT_EQ(parameters.stage1.rho, 4);
  EXPECT_EQ(parameters.shape.rounds, 2);
  set_parameter("budget.seconds=null", parameters);
  EXPECT_FALSE(parameters.budget.seconds.has_value());
}

TEST(Config, SetRefusesWhatFilesRefuse) {
  EXPECT_TRUE(contains(set_refusal("stage1.epsilon"), "expected key.path=value"));
  EXPECT_TRUE(contains(set_refusal("=3"), "expected key.path=value"));
  EXPECT_TRUE(contains(set_refusal("stage1=3"), "group of keys"));
  EXPECT_TRUE(contains(set_refusal("stage1.epsilon=nan"), "found \"nan\""));
  EXPECT_TRUE(contains(set_refusal("stage1.epsilon=inf"), "found \"inf\""));
  EXPECT_TRUE(contains(set_refusal("stage1.epsilon=1e999"), "a number > 0"));
  EXPECT_TRUE(contains(set_refusal("stage1.epsilon="), "a number > 0"));
  EXPECT_TRUE(contains(set_refusal("stage3.epsilon=1"), "nearest known key is 'stage1.epsilon'"));
}

TEST(Config, PresetsParseAndDifferFromTheDefaults) {
  for (const std::string name : {"paper/parameters.json", "paper/fitted.json", "smoke/default.json"}) {
    const Parameters parameters = read_parameters(std::string(DELISO_SOURCE_DIR) + "/configs/" + name);
    EXPECT_EQ(parameters_to_json(parameters) == parameters_to_json(Parameters{}), name == "smoke/default.json") << name;
  }
}

// The paper's choices, from the paper.
TEST(Config, PaperPresetHoldsThePapersChoices) {
  const Parameters p = read_parameters(std::string(DELISO_SOURCE_DIR) + "/configs/paper/parameters.json");
  EXPECT_EQ(p.algorithm, Algorithm::kTwoStage);
  EXPECT_EQ(p.initial.seeding, Seeding::kRandom);
  EXPECT_GT(p.initial.random_points, 0);
  EXPECT_EQ(p.stage1.epsilon, 0.2);
  EXPECT_EQ(p.stage2.epsilon1, 0.1);
  EXPECT_EQ(p.stage2.epsilon2, 0.2);
  EXPECT_EQ(p.stage1.rho, 2);
  EXPECT_EQ(p.stage2.rho, 2);
  EXPECT_EQ(p.stage1.r_min, 0.001);
  EXPECT_EQ(p.stage1.size_bound_voxels, 0);  // no bound but r_min
  EXPECT_EQ(p.stage2.r_min, 0.001);
  EXPECT_EQ(p.search.solver, CubicSolver::kSchwarze);
  EXPECT_EQ(p.search.leaf_cells, 1);
  EXPECT_EQ(p.repair.max_rounds, 0);
  EXPECT_EQ(p.spacing, SpacingUse::kIgnore);
}

}  // namespace
}  // namespace deliso
