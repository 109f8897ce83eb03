// The schema of parameters and their parser come from one table; these tests check that they accept the same documents,
// with a small validator of our own.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "experiments/config/config.h"
#include "tests/support/json_schema.h"
#include "tests/support/program_runner.h"

namespace deliso {
namespace {

using testing::validates;

bool parses(const Json& document) {
  try {
    Parameters parameters;
    apply_parameters(document, "document", parameters);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Values that sit on and around the limits of every type.
const std::vector<Json>& probes() {
  static const std::vector<Json> kProbes = {
      nullptr,  true,          false,          -1,       0,          1,          2,      3,     4,      1.5,
      2.0,      -0.001,        1e-300,         1e300,    2147483647, 2147483648, "open", "use", "fifo", "",
      "full3d", Json::array(), Json::object(), "random", "schwarze"};
  return kProbes;
}

TEST(Schema, AgreesWithTheParserOnEveryKeyAndProbe) {
  const Json schema = parameters_schema();
  const Json defaults = parameters_to_json(Parameters{});
  int taken = 0;
  int refused = 0;
  const auto compare = [&](const Json& document) {
    const bool ok = parses(document);
    EXPECT_EQ(validates(schema, document), ok) << document;
    ++(ok ? taken : refused);
  };
  for (const auto& [key, value] : defaults.items()) {
    for (const Json& probe : probes()) {
      Json document = defaults;
      document[key] = probe;
      compare(document);
      if (!value.is_object()) continue;
      for (const auto& [inner_key, inner_value] : value.items()) {
        document = defaults;
        document[key][inner_key] = probe;
        compare(document);
      }
    }
  }
  EXPECT_GT(taken, 50);
  EXPECT_GT(refused, 200);
}

TEST(Schema, RefusesUnknownKeys) {
  const Json schema = parameters_schema();
  EXPECT_FALSE(validates(schema, parse_json(R"({"stage3": {}})", "test")));
  EXPECT_FALSE(validates(schema, parse_json(R"({"stage1": {"epsilon3": 1}})", "test")));
}

TEST(Schema, DefaultsInTheSchemaAreTheDefaults) {
  const Json schema = parameters_schema();
  const Json defaults = parameters_to_json(Parameters{});
  for (const auto& [key, value] : defaults.items()) {
    const Json& property = schema["properties"][key];
    if (!value.is_object()) {
      EXPECT_EQ(property["default"], value) << key;
    }
    if (!value.is_object()) continue;
    for (const auto& [inner_key, inner_value] : value.items()) {
      EXPECT_EQ(property["properties"][inner_key]["default"], inner_value) << key << '.' << inner_key;
    }
  }
}

TEST(Schema, TheCommandPrintsIt) {
  const testing::ProgramResult result = testing::run_deliso({"schema"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json document = parse_json(result.out, "schema");
  EXPECT_EQ(document["$ref"], "#/$defs/parameters");
  EXPECT_EQ(document["$defs"]["parameters"], parameters_schema());
}

TEST(Schema, ThePageHoldsTheTableOfTheParameters) {
  const testing::ProgramResult result = testing::run_deliso({"schema", "--markdown"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = testing::read_file(std::string(DELISO_SOURCE_DIR) + "/experiments/config/README.md");
  EXPECT_NE(page.find(result.out), std::string::npos)
      << "experiments/config/README.md must hold the output of `deliso schema --markdown`:\n"
      << result.out;
}

}  // namespace
}  // namespace deliso
