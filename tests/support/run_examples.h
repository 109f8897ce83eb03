// Small experiments for the tests of `deliso run` and `deliso table`.
#pragma once

#include <string>

#include "experiments/runs/experiment_config.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {

// Two data sets, two variants, three repeats; figures without seconds, so that equal runs give equal tables.
inline constexpr const char* kSmallExperiment = R"({
  "title": "Small",
  "datasets": [
    {"name": "ball", "field": "sphere", "size": 8},
    {"name": "ring", "field": "torus", "size": 10}
  ],
  "base": {"name": "default", "parameters": {"initial": {"random_points": 10}}},
  "variants": [
    {"name": "fine", "extends": "default"},
    {"name": "coarse", "extends": "fine", "set": {"stage2.epsilon1": 0.3}}
  ],
  "repeats": 3,
  "metrics": [
    {"name": "vertices", "value": "vertices"},
    {"name": "share", "value": "vertices", "over": "fine"},
    {"name": "cubics", "value": "stages.recover.solves", "per": "stages.recover.searches"},
    {"name": "verdict", "value": "certificate.verdict"}
  ]
})";

// The experiment after a change to its JSON, as a document.
inline Json small_document() { return parse_json(kSmallExperiment, "small.json"); }

inline Experiment small_experiment() { return parse_experiment(small_document(), "small.json"); }

// The Markdown table without the names of programs and machines, which differ where the table does not.
inline std::string without_programs(const std::string& markdown) {
  return markdown.substr(0, markdown.find("Made by"));
}

}  // namespace deliso::testing
