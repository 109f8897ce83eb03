// The mesher's parameters as JSON: strict parsing, writing, `--set`, help and schema, all from the table in
// parameter_table.h.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "experiments/config/json.h"
#include "surface/base/parameter_table.h"
#include "surface/base/parameter_value.h"
#include "surface/base/parameters.h"

namespace deliso {

// Sets the parameters that `document` names and leaves the others as they are. Throws InputError that begins with
// `source` (a file, say) and names the full key path: an unknown key (with the nearest known one), a value of the wrong
// type, or one out of range (with the allowed range).
void apply_parameters(const Json& document, const std::string& source, Parameters& parameters);

// The defaults, changed by the file: parameters, or a document that holds them under the key `parameters`, such as a
// report.
Parameters read_parameters(const std::filesystem::path& path);

// Whether a document is what read_parameters takes: it holds parameters, or a key of the top level is one of them.
bool is_parameter_document(const Json& document);

Json value_to_json(const ParameterValue& value);

// Every parameter, also those that have their default.
Json parameters_to_json(const Parameters& parameters);

// A value as it is typed on a command line: as in JSON, but numbers like .5 and +2, too. All else is text, so that a
// choice needs no quotes.
Json typed_value(const std::string& text);

// One `--set key.path=value`. The value is written as in JSON; the quotes of a choice may be left out. Throws
// InputError like apply_parameters, and when the '=' is missing.
void set_parameter(std::string_view assignment, Parameters& parameters);

// The same with the value as JSON and the key path by itself; `source` begins the messages.
void set_parameter(std::string_view path, const Json& value, const std::string& source, Parameters& parameters);

// JSON Schema (draft 2020-12) of a parameters file. It accepts exactly what apply_parameters accepts.
Json parameters_schema();

// One line per parameter for `--help`: path, default, allowed values, effect.
std::string parameters_help();

// The same as a Markdown table.
std::string parameters_markdown();

}  // namespace deliso
