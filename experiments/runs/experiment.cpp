#include "experiments/runs/experiment.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "experiments/system/parse_number.h"

namespace deliso {

std::vector<PlannedRun> planned_runs(const Experiment& experiment) {
  std::vector<PlannedRun> runs;
  for (std::size_t dataset = 0; dataset < experiment.datasets.size(); ++dataset) {
    // By turns: what slows the machine down for a while meets all variants alike.
    for (std::int32_t repeat = 1; repeat <= experiment.repeats; ++repeat) {
      for (std::size_t variant = 0; variant < experiment.variants.size(); ++variant) {
        runs.push_back({dataset, variant, repeat});
      }
    }
  }
  return runs;
}

Shard parse_shard(const std::string& text) {
  constexpr std::uint64_t kMost = 1'000'000;
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw InputError("--shard: expected I/N, for instance 2/5, found '" + text + "'");
  Shard shard;
  shard.count = parse_count(text.substr(slash + 1), "--shard: N of I/N", 1, kMost);
  shard.index = parse_count(text.substr(0, slash), "--shard: I of I/N", 1, shard.count);
  return shard;
}

std::vector<PlannedRun> runs_of(const Experiment& experiment, const Shard& shard) {
  std::vector<PlannedRun> runs;
  const std::vector<PlannedRun> all = planned_runs(experiment);
  for (std::size_t i = shard.index - 1; i < all.size(); i += shard.count) runs.push_back(all[i]);
  return runs;
}

namespace {

// Removes data sets that are gone from the lines of plots, then lines without data sets, then plots without lines.
void prune_plots(Experiment& experiment) {
  const auto is_gone = [&experiment](const std::string& name) {
    return std::none_of(experiment.datasets.begin(), experiment.datasets.end(),
                        [&name](const Dataset& dataset) { return dataset.name == name; });
  };
  for (Plot& plot : experiment.plots) {
    if (!plot.across_datasets) continue;
    for (PlotSeries& series : plot.series) std::erase_if(series.members, is_gone);
    std::erase_if(plot.series, [](const PlotSeries& series) { return series.members.empty(); });
  }
  std::erase_if(experiment.plots, [](const Plot& plot) { return plot.across_datasets && plot.series.empty(); });
}

// Drops the published figures, which are of other data sets than the remaining ones.
void forget_reference(Experiment& experiment) {
  for (const Dataset& dataset : experiment.datasets) {
    if (experiment.reference.rows.contains(dataset.name)) return;
  }
  experiment.reference = {};
  for (Metric& metric : experiment.metrics) {
    metric.reference.clear();
    metric.ratio = false;
  }
}

}  // namespace

Experiment builtin_form(Experiment experiment) {
  if (experiment.builtin_datasets.empty()) {
    const auto file = std::find_if(experiment.datasets.begin(), experiment.datasets.end(),
                                   [](const Dataset& dataset) { return dataset.field.empty(); });
    if (file == experiment.datasets.end()) return experiment;
    throw InputError("--builtin: the experiment " + experiment.name + " needs the file " + file->file +
                     " and names no builtin_datasets");
  }
  experiment.datasets = std::move(experiment.builtin_datasets);
  experiment.builtin_datasets.clear();
  experiment.name += "_builtin";
  experiment.answers.clear();  // they are about the other data sets
  prune_plots(experiment);
  forget_reference(experiment);
  return experiment;
}

Experiment smoke_form(Experiment experiment) {
  Dataset tiny;
  tiny.name = "tiny sphere";
  tiny.field = "sphere";
  tiny.size = 8;
  tiny.isovalue = 0.3;
  experiment.datasets = {tiny};
  experiment.builtin_datasets.clear();
  experiment.repeats = 1;
  experiment.name += "_smoke";
  // Other programs may not be there, and are not ours to try.
  std::erase_if(experiment.variants, [](const Variant& variant) {
    return variant.mesher == Mesher::kCommand && variant.command.arguments.front() != "{deliso}";
  });
  experiment.answers.clear();
  for (Plot& plot : experiment.plots) {
    if (plot.across_datasets) plot.series = {{"smoke", {tiny.name}}};
  }
  forget_reference(experiment);
  return experiment;
}

}  // namespace deliso
