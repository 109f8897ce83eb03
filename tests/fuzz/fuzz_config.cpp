// Text as parameters: a JSON file when it begins with a brace (or as an experiment when a line "experiment" precedes
// it), else lines that each are the value of --set.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "experiments/runs/experiment_config.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/json_schema.h"

namespace deliso::fuzz {
namespace {

template <class Action>
bool is_accepted(const Action& action) {
  try {
    action();
    return true;
  } catch (const InputError& error) {
    require(std::string_view(error.what()).size() > 10, "a refusal is a sentence", error.what());
    return false;
  }
}

std::optional<Json> parsed(const std::string& text) {
  std::optional<Json> document;
  is_accepted([&] { document = parse_json(text, "file.json"); });
  return document;
}

// Writing and reading parameters gives the same parameters.
void require_round_trip(const Parameters& parameters) {
  const Json written = parameters_to_json(parameters);
  Parameters again;
  apply_parameters(parse_json(json_text(written), "written"), "written", again);
  require(parameters_to_json(again) == written, "parameters are kept", json_text(written));
}

void try_parameters(const Json& document) {
  static const Json kSchema = parameters_schema();
  Parameters parameters;
  const bool accepted = is_accepted([&] { apply_parameters(document, "file.json", parameters); });
  require(accepted == testing::validates(kSchema, document), "the schema accepts what the program accepts",
          json_text(document));
  if (!accepted) return;
  require_round_trip(parameters);
  is_accepted([&] { check_parameters(parameters); });
}

void try_experiment(const Json& document) {
  is_accepted([&] {
    const Experiment experiment = parse_experiment(document, "/experiments/e.json");
    const Json written = experiment_to_json(experiment);
    const Experiment again = parse_experiment(written, "/experiments/e.json");
    require(experiment_to_json(again) == written, "an experiment is kept", json_text(written));
  });
}

void try_assignments(std::string_view text) {
  constexpr int kMost = 20;
  Parameters parameters;
  for (int n = 0; n < kMost && !text.empty(); ++n) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    is_accepted([&] { set_parameter(text.substr(0, end), parameters); });
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  require_round_trip(parameters);
}

void run(std::string_view text) {
  constexpr std::string_view kExperiment = "experiment\n";
  const bool is_experiment = text.substr(0, kExperiment.size()) == kExperiment;
  if (is_experiment) text.remove_prefix(kExperiment.size());
  if (!is_experiment && (text.empty() || text.front() != '{')) return try_assignments(text);
  const std::optional<Json> document = parsed(std::string(text));
  if (document && is_experiment) try_experiment(*document);
  if (document && !is_experiment) try_parameters(*document);
}

}  // namespace
}  // namespace deliso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deliso::fuzz::run(deliso::fuzz::text_of(data, size));
  return 0;
}
