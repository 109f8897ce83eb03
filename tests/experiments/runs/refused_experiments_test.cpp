// Experiments that are refused as a whole, or for what they would be expanded to.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

// The sentences with which the document is refused; empty when it is taken.
std::string sentences_for(const Json& document) {
  try {
    parse_experiment(document, "small.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string sentences_with(const std::string& pointer, const Json& value) {
  Json document = small_document();
  document[Json::json_pointer(pointer)] = value;
  return sentences_for(document);
}

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The reverse mistake, an experiment where parameters are expected, has its sentence too.
TEST(RefusedExperiments, AParameterFileIsToldInOneSentence) {
  const Json all = parameters_to_json(Parameters{});
  for (const Json& document : {all, Json{{"stage1", {{"epsilon", 0.1}}}}, Json{{"parameters", all}}}) {
    const std::string told = sentences_for(document);
    EXPECT_TRUE(
        has_part(told, "small.json: this is a parameter file (for deliso mesh --config), expected an experiment"))
        << told;
    EXPECT_FALSE(has_part(told, "\n") || has_part(told, "unknown key")) << told;
  }
  // One stray parameter makes no experiment a file of parameters.
  EXPECT_TRUE(has_part(sentences_with("/stage1", Json::object()), "small.json: unknown key 'stage1'"));
}

TEST(RefusedExperiments, WithoutABaseNoNameIsTheNearest) {
  Json document = small_document();
  document.erase("base");
  const std::string told = sentences_for(document);
  EXPECT_TRUE(has_part(told, "the key 'base' is missing")) << told;
  EXPECT_TRUE(has_part(told, "/variants/0/extends names no variant: 'default', and none is known here")) << told;
  EXPECT_FALSE(has_part(told, "''")) << told;
}

TEST(RefusedExperiments, IntegersBeyondDoublesAreNotTheirNeighbours) {
  EXPECT_EQ(sentences_with("/seed", 9007199254740992), "");
  for (const Json& seed : {Json(9007199254740993), Json(std::uint64_t{9007199254740993})}) {
    EXPECT_TRUE(has_part(sentences_with("/seed", seed), "#/seed must be an integer from 0 to 9007199254740992"));
  }
}

TEST(RefusedExperiments, SweepsHaveNoValueTwiceHoweverItIsWritten) {
  EXPECT_TRUE(has_part(sentences_with("/sweep", parse_json(R"({"stage1.rho": [2, 2.0]})", "sweep")),
                       "#/sweep/stage1.rho has the value 2.0 twice"));
}

// Found before any variant is made: these would not fit into memory.
TEST(RefusedExperiments, SweepsOfTooManyVariantsAreRefused) {
  Json many = Json::array();
  for (int i = 1; i <= 1000; ++i) many.push_back(i * 1e-3);
  const Json sweep{{"stage1.epsilon", many}, {"stage2.epsilon1", many}, {"stage2.epsilon2", many}};
  const std::string told = sentences_with("/sweep", sweep);
  EXPECT_TRUE(has_part(told, "small.json#/sweep makes more than 100000 variants, expected fewer values")) << told;
}

}  // namespace
}  // namespace deliso::testing
