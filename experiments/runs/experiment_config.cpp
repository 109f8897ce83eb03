#include "experiments/runs/experiment_config.h"

#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/config/config.h"
#include "experiments/runs/answer_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/plot_config.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

std::string item_place(const StrictObject& object, const std::string& key, std::size_t index) {
  return object.place_of(key) + "/" + std::to_string(index);
}

void apply_set(const StrictObject& object, Parameters& parameters) {
  if (!object.has("set")) return;
  for (const auto& [path, value] : object.at("set").items()) {
    set_parameter(path, value, object.place_of("set"), parameters);
  }
}

// The name of the experiment, which is also the name of its folder of results.
std::string folder_name(const StrictObject& object, const fs::path& path) {
  auto name = object.get("name", path.stem().string());
  if (name.find('/') != std::string::npos || name.starts_with('.')) {
    object.fail("name", "becomes the name of a folder: no '/' in it and no '.' before it, not '" + name + "'");
  }
  return name;
}

Variant parse_base(const StrictObject& experiment, const fs::path& folder) {
  const StrictObject object(experiment.at("base"), experiment.place_of("base"), kBaseKeys);
  Variant base;
  base.name = object.get<std::string>("name", "");
  const Json& parameters = object.at("parameters");
  if (parameters.is_string()) {
    base.parameters = read_parameters(folder / parameters.get<std::string>());
  } else {
    apply_parameters(parameters, object.place_of("parameters"), base.parameters);
  }
  apply_set(object, base.parameters);
  return base;
}

// The variant of this name.
const Variant& find_variant(const std::string& name, const std::vector<Variant>& variants, const StrictObject& object,
                            std::string_view key) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) {
    if (variant.name == name) return variant;
    names.push_back(variant.name);
  }
  object.fail(key, "names no variant: '" + name + "', the nearest is '" + nearest_name(name, names) + "'");
}

// Each variant is the base or an earlier variant, with a few keys changed.
std::vector<Variant> parse_variants(const StrictObject& experiment, const Variant& base) {
  if (!experiment.has("variants")) return {base};
  std::vector<Variant> known = {base};
  std::vector<Variant> variants;
  std::set<std::string> names;
  for (std::size_t i = 0; i < experiment.at("variants").size(); ++i) {
    const StrictObject object(experiment.at("variants")[i], item_place(experiment, "variants", i), kVariantKeys);
    const auto name = object.get<std::string>("name", "");
    if (!names.insert(name).second) object.fail("name", "'" + name + "' is the name of two variants");
    Variant variant = base;
    if (object.has("extends")) variant = find_variant(object.get<std::string>("extends", ""), known, object, "extends");
    variant.name = name;
    if (object.has("mesher")) {
      variant.mesher =
          object.get<std::string>("mesher", "") == kMesherNames[1] ? Mesher::kMarchingCubes : Mesher::kDelIso;
    }
    apply_set(object, variant.parameters);
    variants.push_back(variant);
    // A variant may have the base's name; variants that extend this name then extend the variant.
    std::erase_if(known, [&name](const Variant& other) { return other.name == name; });
    known.push_back(variant);
  }
  return variants;
}

// Every variant combined with every value of one more key.
std::vector<Variant> swept(const std::vector<Variant>& variants, const std::string& path, const Json& values,
                           const std::string& place) {
  check_parameter_path(path, place);
  if (!values.is_array() || values.empty()) {
    throw InputError(place + " must be a list of values that is not empty, found " + short_json(values));
  }
  std::vector<Variant> all;
  for (const Variant& variant : variants) {
    std::set<std::string> seen;
    for (const Json& value : values) {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      if (!seen.insert(text).second) {
        throw InputError(std::string(place).append(" has the value ").append(text).append(" twice"));
      }
      Variant& one = all.emplace_back(variant);
      one.name.append(" ").append(path).append("=").append(text);
      set_parameter(path, value, place, one.parameters);
    }
  }
  return all;
}

std::vector<Variant> parse_all_variants(const StrictObject& experiment, const Variant& base) {
  std::vector<Variant> variants = parse_variants(experiment, base);
  if (!experiment.has("sweep")) return variants;
  for (const auto& [path, values] : experiment.at("sweep").items()) {
    variants = swept(variants, path, values, experiment.place_of("sweep").append("/").append(path));
  }
  return variants;
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

void check_path(const StrictObject& object, std::string_view key, const Experiment& experiment,
                const std::vector<std::string>& paths) {
  if (!object.has(key)) return;
  const auto path = object.get<std::string>(key, "");
  const auto is_in = [&path](const std::vector<std::string>& known) {
    return std::find(known.begin(), known.end(), path) != known.end();
  };
  if (is_in(paths)) return;
  if (experiment.task == Task::kMesh && is_in(record_paths(Task::kMesh, true))) {
    object.fail(key,
                "needs \"distances\": true in the experiment: '" + path + "' is a figure of its records only then");
  }
  object.fail(key, "names no figure of a record: '" + path + "', the nearest is '" + nearest_name(path, paths) + "'");
}

void check_column(const StrictObject& object, const Reference& reference) {
  if (!object.has("reference")) return;
  const auto column = object.get<std::string>("reference", "");
  std::vector<std::string> columns;
  for (const auto& [dataset, row] : reference.rows) {
    if (row.contains(column)) return;
    for (const auto& [name, value] : row) columns.push_back(name);
  }
  object.fail("reference", "names no column of the reference: '" + column + "'" + nearest_name_hint(column, columns));
}

std::vector<Metric> parse_metrics(const StrictObject& object, const Experiment& experiment) {
  const std::vector<std::string> paths = record_paths(experiment.task, experiment.distances);
  std::vector<Metric> metrics;
  std::set<std::string> names;
  for (std::size_t i = 0; i < object.at("metrics").size(); ++i) {
    const StrictObject item(object.at("metrics")[i], item_place(object, "metrics", i), kMetricKeys);
    check_path(item, "value", experiment, paths);
    check_path(item, "per", experiment, paths);
    check_column(item, experiment.reference);
    Metric metric;
    metric.name = item.get<std::string>("name", "");
    metric.value = item.get<std::string>("value", "");
    metric.per = item.get<std::string>("per", "");
    metric.variant = item.get<std::string>("variant", "");
    metric.over = item.get<std::string>("over", "");
    metric.reference = item.get<std::string>("reference", "");
    metric.ratio = item.get("ratio", false);
    for (const std::string_view key : {"variant", "over"}) {
      if (item.has(key)) find_variant(item.get<std::string>(key, ""), experiment.variants, item, key);
    }
    if (experiment.rows == RowKind::kDatasets && metric.variant.empty() && experiment.variants.size() > 1) {
      item.fail("variant", "is needed where rows are data sets and there are several variants");
    }
    if (metric.ratio && metric.reference.empty()) item.fail("ratio", "needs a reference");
    if (!names.insert(metric.name).second) item.fail("name", "'" + metric.name + "' heads two columns");
    metrics.push_back(metric);
  }
  return metrics;
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

Json metrics_to_json(const std::vector<Metric>& metrics) {
  Json list = Json::array();
  for (const Metric& metric : metrics) {
    Json& item = list.emplace_back(Json{{"name", metric.name}, {"value", metric.value}});
    if (!metric.per.empty()) item["per"] = metric.per;
    if (!metric.variant.empty()) item["variant"] = metric.variant;
    if (!metric.over.empty()) item["over"] = metric.over;
    if (!metric.reference.empty()) item["reference"] = metric.reference;
    if (metric.ratio) item["ratio"] = true;
  }
  return list;
}

Json variants_to_json(const Experiment& experiment) {
  Json list = Json::array();
  for (const Variant& variant : experiment.variants) {
    Json& item = list.emplace_back(
        Json{{"name", variant.name}, {"set", parameter_changes(experiment.base.parameters, variant.parameters)}});
    if (variant.mesher != Mesher::kDelIso) item["mesher"] = kMesherNames[static_cast<std::size_t>(variant.mesher)];
  }
  return list;
}

}  // namespace

Experiment parse_experiment(const Json& document, const fs::path& path) {
  const StrictObject object(document, path.string() + "#", kExperimentKeys);
  const fs::path folder = path.parent_path();
  Experiment experiment;
  experiment.name = folder_name(object, path);
  experiment.title = object.get<std::string>("title", "");
  experiment.question = object.get<std::string>("question", "");
  experiment.notes = parse_notes(object);
  experiment.task = object.get<std::string>("task", "mesh") == "topology" ? Task::kTopology : Task::kMesh;
  experiment.distances = object.get("distances", false);
  if (experiment.distances && experiment.task == Task::kTopology) object.fail("distances", "needs the task mesh");
  experiment.rows = object.get<std::string>("rows", "runs") == "datasets" ? RowKind::kDatasets : RowKind::kRuns;
  experiment.repeats = object.get("repeats", 1);
  experiment.seed = object.get("seed", std::uint64_t{1});
  parse_datasets(object, folder, experiment);
  experiment.base = parse_base(object, folder);
  experiment.variants = parse_all_variants(object, experiment.base);
  experiment.reference = parse_reference(object, folder);
  experiment.metrics = parse_metrics(object, experiment);
  experiment.plots = parse_plots(object, experiment);
  experiment.answers = parse_answers(object, experiment);
  return experiment;
}

Experiment read_experiment(const fs::path& path) { return parse_experiment(read_json(path), path); }

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
