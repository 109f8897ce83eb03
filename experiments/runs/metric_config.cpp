#include "experiments/runs/metric_config.h"

#include <algorithm>
#include <set>

#include "delaunay/base/nearest_name.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/variant_config.h"

namespace deliso {
namespace {

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

// What is divided, and by what, are numbers.
void check_numbers(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes) {
  const bool is_quotient = object.has("per") || object.has("over") || object.get("ratio", false);
  for (const std::string_view key : {"value", "per"}) {
    if (!is_quotient || !object.has(key)) continue;
    mistakes.gather([&] {
      const auto path = object.get<std::string>(key, "");
      if (is_no_number(experiment, path))
        object.fail(key, "is no number, of which there are quotients: '" + path + "'");
    });
  }
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

}  // namespace

std::vector<Metric> parse_metrics(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes) {
  std::vector<Metric> metrics;
  if (!object.has("metrics")) return metrics;
  const std::vector<std::string>& paths = record_paths(experiment.task, experiment.distances);
  std::set<std::string> names;
  for (std::size_t i = 0; i < object.at("metrics").size(); ++i) {
    const StrictObject item(object.at("metrics")[i], object.place_of("metrics") + "/" + std::to_string(i), kMetricKeys,
                            &mistakes);
    mistakes.gather([&] { check_path(item, "value", experiment, paths); });
    mistakes.gather([&] { check_path(item, "per", experiment, paths); });
    check_numbers(item, experiment, mistakes);
    mistakes.gather([&] { check_column(item, experiment.reference); });
    Metric metric;
    metric.name = item.get<std::string>("name", "");
    metric.value = item.get<std::string>("value", "");
    metric.per = item.get<std::string>("per", "");
    metric.variant = item.get<std::string>("variant", "");
    metric.over = item.get<std::string>("over", "");
    metric.reference = item.get<std::string>("reference", "");
    metric.ratio = item.get("ratio", false);
    for (const std::string_view key : {"variant", "over"}) {
      mistakes.gather([&] {
        if (item.has(key)) find_variant(item.get<std::string>(key, ""), experiment.variants, item, key);
      });
    }
    mistakes.gather([&] {
      if (experiment.rows == RowKind::kDatasets && metric.variant.empty() && experiment.variants.size() > 1) {
        item.fail("variant", "is needed where rows are data sets and there are several variants");
      }
      if (metric.ratio && metric.reference.empty()) item.fail("ratio", "needs a reference");
      if (!names.insert(metric.name).second) item.fail("name", "'" + metric.name + "' heads two columns");
    });
    metrics.push_back(metric);
  }
  return metrics;
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

}  // namespace deliso
