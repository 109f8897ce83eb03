#include "experiments/runs/experiment_config.h"

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/config/config.h"
#include "experiments/config/mistakes.h"
#include "experiments/runs/answer_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/metric_config.h"
#include "experiments/runs/plot_config.h"
#include "experiments/runs/variant_config.h"
#include "experiments/system/files.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

std::string item_place(const StrictObject& object, const std::string& key, std::size_t index) {
  return object.place_of(key) + "/" + std::to_string(index);
}

// The name of the experiment, which is also the name of its folder of results.
std::string folder_name(const StrictObject& object, const fs::path& path) {
  auto name = object.get("name", path.stem().string());
  if (name.find('/') != std::string::npos || name.starts_with('.')) {
    object.fail("name", "becomes the name of a folder: no '/' in it and no '.' before it, not '" + name + "'");
  }
  return name;
}

Reference parse_reference(const StrictObject& experiment, const fs::path& folder) {
  Reference reference;
  if (!experiment.has("reference")) return reference;
  const bool is_file = experiment.at("reference").is_string();
  const fs::path file = is_file ? folder / experiment.at("reference").get<std::string>() : fs::path();
  const Json document = is_file ? read_json(file) : experiment.at("reference");
  const StrictObject object(document, is_file ? file.string() + "#" : experiment.place_of("reference"), kReferenceKeys);
  reference.source = object.get<std::string>("source", "");
  for (const auto& [dataset, row] : object.at("rows").items()) {
    const std::string place = object.place_of("rows").append("/").append(dataset);
    if (!row.is_object()) throw InputError(place + " must be an object, found " + short_json(row));
    for (const auto& [column, value] : row.items()) {
      if (!value.is_number() && !value.is_string()) {
        throw InputError(std::string(place).append("/").append(column) + " must be a number or a string, found " +
                         short_json(value));
      }
      reference.rows[dataset][column] = value;
    }
  }
  return reference;
}

std::vector<std::string> parse_notes(const StrictObject& object) {
  std::vector<std::string> notes;
  if (!object.has("notes")) return notes;
  for (const Json& note : object.at("notes")) {
    if (!note.is_string() || note.get_ref<const std::string&>().empty()) {
      throw InputError(item_place(object, "notes", notes.size()) + " must be a string that is not empty, found " +
                       short_json(note));
    }
    notes.push_back(note.get<std::string>());
  }
  return notes;
}

// The other kind of file that programs take: all of its keys would be unknown here.
void refuse_parameters(const Json& document, const fs::path& path) {
  if (!is_parameter_document(document)) return;
  for (const char* const key : {"base", "datasets", "metrics", "variants"}) {
    if (document.contains(key)) return;
  }
  throw InputError(path.string() +
                   ": this is a parameter file (for deliso mesh --config), expected an experiment, which has datasets, "
                   "metrics, and a base whose parameters may name such a file");
}

// Goes on after a mistake with what is right, so that all mistakes are found. What hangs on names that cannot be known
// is not looked at.
Experiment parse_gathering(const Json& document, const fs::path& path, Mistakes& mistakes) {
  refuse_parameters(document, path);
  const StrictObject object(document, path.string() + "#", kExperimentKeys, &mistakes);
  const fs::path folder = path.parent_path();
  Experiment experiment;
  mistakes.gather([&] { experiment.name = folder_name(object, path); });
  experiment.title = object.get<std::string>("title", "");
  experiment.question = object.get<std::string>("question", "");
  mistakes.gather([&] { experiment.notes = parse_notes(object); });
  experiment.task = object.get<std::string>("task", "mesh") == "topology" ? Task::kTopology : Task::kMesh;
  experiment.distances = object.get("distances", false);
  mistakes.gather([&] {
    if (experiment.distances && experiment.task == Task::kTopology) object.fail("distances", "needs the task mesh");
  });
  experiment.rows = object.get<std::string>("rows", "runs") == "datasets" ? RowKind::kDatasets : RowKind::kRuns;
  experiment.repeats = object.get("repeats", 1);
  experiment.seed = object.get("seed", std::uint64_t{1});
  const bool knows_datasets = parse_datasets(object, folder, experiment, mistakes);
  experiment.base = parse_base(object, folder, mistakes);
  const bool knows_variants =
      mistakes.gather([&] { experiment.variants = parse_all_variants(object, experiment.base, folder, mistakes); });
  mistakes.gather([&] { experiment.reference = parse_reference(object, folder); });
  if (!knows_variants) return experiment;
  experiment.metrics = parse_metrics(object, experiment, mistakes);
  if (!knows_datasets || experiment.metrics.empty()) return experiment;
  mistakes.gather([&] { experiment.plots = parse_plots(object, experiment, mistakes); });
  mistakes.gather([&] { experiment.answers = parse_answers(object, experiment, mistakes); });
  return experiment;
}

}  // namespace

Experiment parse_experiment(const Json& document, const fs::path& path) {
  Mistakes mistakes;
  Experiment experiment = parse_gathering(document, path, mistakes);
  mistakes.throw_all();
  return experiment;
}

Experiment read_experiment(const fs::path& path) {
  const std::string text = read_text(path);
  Mistakes mistakes;
  Experiment experiment = parse_gathering(parse_json(text, path.string()), path, mistakes);
  mistakes.throw_all(path.string(), text);
  return experiment;
}

Json parameter_changes(const Parameters& base, const Parameters& variant) {
  Json changes = Json::object();
  for (const ParameterField& field : parameter_table()) {
    const ParameterValue value = field.get(variant);
    if (value != field.get(base)) changes[std::string(field.path)] = value_to_json(value);
  }
  return changes;
}

Json experiment_to_json(const Experiment& experiment) {
  Json json{{"name", experiment.name}, {"title", experiment.title}};
  if (!experiment.question.empty()) json["question"] = experiment.question;
  if (!experiment.notes.empty()) json["notes"] = experiment.notes;
  json["task"] = kTaskNames[static_cast<std::size_t>(experiment.task)];
  json["distances"] = experiment.distances;
  json["datasets"] = datasets_to_json(experiment.datasets);
  if (!experiment.builtin_datasets.empty()) json["builtin_datasets"] = datasets_to_json(experiment.builtin_datasets);
  json["base"] = Json{{"name", experiment.base.name}, {"parameters", parameters_to_json(experiment.base.parameters)}};
  json["variants"] = variants_to_json(experiment);
  json["repeats"] = experiment.repeats;
  json["seed"] = experiment.seed;
  json["rows"] = kRowNames[static_cast<std::size_t>(experiment.rows)];
  json["metrics"] = metrics_to_json(experiment.metrics);
  if (!experiment.answers.empty()) json["answers"] = answers_to_json(experiment.answers);
  if (!experiment.plots.empty()) json["plots"] = plots_to_json(experiment.plots);
  if (!experiment.reference.rows.empty()) {
    json["reference"] = Json{{"source", experiment.reference.source}, {"rows", experiment.reference.rows}};
  }
  return json;
}

}  // namespace deliso
