// Experiments as JSON: strict parsing, writing, schema.
//
// Messages give the position as file and JSON pointer (RFC 6901): "table3.json#/metrics/2/value". Paths in a file are
// relative to its folder.
#pragma once

#include <filesystem>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// Throws InputError: an unknown key, name or parameter (with the nearest known one), a value of the wrong type or out
// of range, a name given twice.
Experiment parse_experiment(const Json& document, const std::filesystem::path& path);

// The experiment in a file; its name is the file's without extension.
Experiment read_experiment(const std::filesystem::path& path);

// The experiment with everything it refers to written out, for parse_experiment to read back.
Json experiment_to_json(const Experiment& experiment);

// The parameters in which `variant` differs from `base`, by key path.
Json parameter_changes(const Parameters& base, const Parameters& variant);

// JSON Schema (draft 2020-12) of an experiment; it refers to the parameters as "#/$defs/parameters".
Json experiment_schema();

}  // namespace deliso
