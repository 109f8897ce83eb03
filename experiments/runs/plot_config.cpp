#include "experiments/runs/plot_config.h"

#include <algorithm>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

// The value of a key that holds a list of names; each must be one of `known`, and no name may come twice.
std::vector<std::string> names_at(const StrictObject& object, std::string_view key, const std::string& kind,
                                  const std::vector<std::string>& known) {
  std::vector<std::string> names;
  if (!object.has(key)) return names;
  for (const Json& item : object.at(key)) {
    const std::string place = object.place_of(key) + "/" + std::to_string(names.size());
    if (!item.is_string()) throw InputError(place + " must be a string, found " + short_json(item));
    const auto name = item.get<std::string>();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(std::string(place).append(" names no ").append(kind).append(": '").append(name).append("'") +
                       nearest_name_hint(name, known));
    }
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      throw InputError(std::string(place).append(": '").append(name).append("' is there twice"));
    }
    names.push_back(name);
  }
  return names;
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

// The keys that a plot of each kind may and must have, beside name, title and kind.
struct KindKeys {
  std::vector<std::string_view> required;
  std::vector<std::string_view> optional;
};

KindKeys keys_of(PlotKind kind) {
  switch (kind) {
    case PlotKind::kCurve:
      return {{"x", "y"}, {"log", "across", "series"}};
    case PlotKind::kBars:
      return {{"y"}, {"share"}};
    case PlotKind::kHistogram:
      return {{"value", "bin_width", "x_label"}, {"series"}};
  }
  return {};
}

void check_keys(const StrictObject& object, PlotKind kind) {
  const std::string kind_name(kPlotKindNames[static_cast<std::size_t>(kind)]);
  const KindKeys keys = keys_of(kind);
  for (const std::string_view key : keys.required) {
    if (!object.has(key)) object.fail(key, "is required for a plot of the kind " + kind_name);
  }
  for (const KeyInfo& key : kPlotKeys) {
    const bool general = key.name == "name" || key.name == "title" || key.name == "kind";
    const auto is_key = [&key](std::string_view name) { return name == key.name; };
    if (general || std::any_of(keys.required.begin(), keys.required.end(), is_key) ||
        std::any_of(keys.optional.begin(), keys.optional.end(), is_key)) {
      continue;
    }
    if (object.has(key.name)) object.fail(key.name, "does not belong to a plot of the kind " + kind_name);
  }
}

// The name becomes that of a file.
std::string file_name(const StrictObject& object) {
  auto name = object.get<std::string>("name", "");
  const bool safe =
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
  if (!safe) object.fail("name", "becomes the name of a file: letters, digits, '-' and '_', not '" + name + "'");
  return name;
}

std::string metric_name(const StrictObject& object, std::string_view key, const std::vector<std::string>& known) {
  auto name = object.get<std::string>(key, "");
  if (std::find(known.begin(), known.end(), name) != known.end()) return name;
  object.fail(key, "names no metric: '" + name + "'" + nearest_name_hint(name, known));
}

// What a curve or bars draw are numbers.
void check_drawn(const StrictObject& object, const Experiment& experiment, const Plot& plot) {
  for (const Metric& metric : experiment.metrics) {
    if (!is_no_number(experiment, metric.value)) continue;
    const auto refuse = [&](std::string_view key) {
      object.fail(key, "can draw numbers alone: the metric '" + metric.name + "' is none");
    };
    if (metric.name == plot.x) refuse("x");
    if (std::find(plot.y.begin(), plot.y.end(), metric.name) != plot.y.end()) refuse("y");
  }
}

void check_counts(const StrictObject& object, const Experiment& experiment) {
  const auto path = object.get<std::string>("value", "");
  std::vector<std::string> lists;
  const Json& empty = empty_record(experiment.task, experiment.distances);
  for (const std::string& one : record_paths(experiment.task, experiment.distances)) {
    const Json held = value_at(empty, one);
    if (held.is_array() && !held.empty() && held[0].is_number()) lists.push_back(one);
  }
  if (std::find(lists.begin(), lists.end(), path) != lists.end()) return;
  object.fail("value", "names no list of numbers of a record: '" + path + "'" + nearest_name_hint(path, lists));
}

// By default a curve goes through all members, and a histogram has a line for each.
std::vector<PlotSeries> parse_series(const StrictObject& object, PlotKind kind,
                                     const std::vector<std::string>& members) {
  std::vector<PlotSeries> series;
  if (!object.has("series")) {
    if (kind == PlotKind::kCurve) return {{"DelIso", members}};
    for (const std::string& member : members) series.push_back({member, {member}});
    return series;
  }
  for (std::size_t i = 0; i < object.at("series").size(); ++i) {
    const StrictObject item(object.at("series")[i], object.place_of("series") + "/" + std::to_string(i), kSeriesKeys);
    series.push_back({item.get<std::string>("name", ""), names_at(item, "members", "variant or data set", members)});
    if (kind == PlotKind::kHistogram && series.back().members.size() != 1) {
      item.fail("members", "are several, a line of a histogram has one");
    }
  }
  return series;
}

Plot parse_plot(const Json& value, const std::string& place, const Experiment& experiment) {
  const StrictObject object(value, place, kPlotKeys);
  Plot plot;
  plot.name = file_name(object);
  plot.title = object.get<std::string>("title", "");
  const auto kind = object.get<std::string>("kind", "");
  const auto found = std::find(kPlotKindNames.begin(), kPlotKindNames.end(), kind);
  plot.kind = static_cast<PlotKind>(found - kPlotKindNames.begin());
  check_keys(object, plot.kind);
  const std::vector<std::string> metrics = names_of(experiment.metrics);
  plot.y = names_at(object, "y", "metric", metrics);
  plot.share = object.get("share", false);
  plot.bin_width = object.get("bin_width", 1.0);
  plot.x_label = object.get<std::string>("x_label", "");
  plot.value = object.get<std::string>("value", "");
  if (plot.kind == PlotKind::kHistogram) check_counts(object, experiment);
  if (plot.kind == PlotKind::kBars) {
    check_drawn(object, experiment, plot);
    return plot;
  }
  if (plot.kind == PlotKind::kCurve) {
    if (experiment.rows == RowKind::kDatasets) object.fail("kind", "curve needs a table whose rows are runs");
    plot.x = metric_name(object, "x", metrics);
    check_drawn(object, experiment, plot);
    const std::vector<std::string> log = names_at(object, "log", "axis", {"x", "y"});
    plot.log_x = std::find(log.begin(), log.end(), "x") != log.end();
    plot.log_y = std::find(log.begin(), log.end(), "y") != log.end();
    plot.across_datasets = object.get<std::string>("across", "") == kAcrossNames[1];
  }
  std::vector<std::string> members = names_of(experiment.variants);
  if (plot.across_datasets) {
    members = names_of(experiment.datasets);
    const std::vector<std::string> fields = names_of(experiment.builtin_datasets);
    members.insert(members.end(), fields.begin(), fields.end());
  }
  plot.series = parse_series(object, plot.kind, members);
  return plot;
}

Json series_to_json(const std::vector<PlotSeries>& series) {
  Json list = Json::array();
  for (const PlotSeries& one : series) list.push_back(Json{{"name", one.name}, {"members", one.members}});
  return list;
}

}  // namespace

std::vector<Plot> parse_plots(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes) {
  std::vector<Plot> plots;
  if (!object.has("plots")) return plots;
  std::set<std::string> names;
  for (std::size_t i = 0; i < object.at("plots").size(); ++i) {
    const std::string place = object.place_of("plots") + "/" + std::to_string(i);
    mistakes.gather([&] {
      plots.push_back(parse_plot(object.at("plots")[i], place, experiment));
      if (!names.insert(plots.back().name).second) {
        throw InputError(place + "/name '" + plots.back().name + "' is the name of two plots");
      }
    });
  }
  return plots;
}

Json plots_to_json(const std::vector<Plot>& plots) {
  Json list = Json::array();
  for (const Plot& plot : plots) {
    Json& item = list.emplace_back(Json{{"name", plot.name}, {"title", plot.title}});
    item["kind"] = kPlotKindNames[static_cast<std::size_t>(plot.kind)];
    if (!plot.x.empty()) item["x"] = plot.x;
    if (!plot.y.empty()) item["y"] = plot.y;
    Json log = Json::array();
    if (plot.log_x) log.push_back(kAxisNames[0]);
    if (plot.log_y) log.push_back(kAxisNames[1]);
    if (!log.empty()) item["log"] = log;
    if (plot.across_datasets) item["across"] = kAcrossNames[1];
    if (!plot.series.empty()) item["series"] = series_to_json(plot.series);
    if (plot.share) item["share"] = true;
    if (plot.kind != PlotKind::kHistogram) continue;
    item["value"] = plot.value;
    item["bin_width"] = plot.bin_width;
    item["x_label"] = plot.x_label;
  }
  return list;
}

}  // namespace deliso
