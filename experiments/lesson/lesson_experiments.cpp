#include "experiments/lesson/lesson_experiments.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/lesson/lesson_modules.h"
#include "experiments/results/answers.h"
#include "experiments/results/table.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/run_record.h"
#include "volume/scalar_grid.h"

namespace deliso {
namespace {

// All runs of an experiment on built-in fields; runs of one data set follow each other.
std::vector<Json> records_of(const Experiment& experiment, const std::atomic<bool>* stop) {
  std::vector<Json> records;
  std::optional<ScalarGrid> grid;
  std::size_t loaded = 0;
  for (const PlannedRun& run : planned_runs(experiment)) {
    if (!grid || loaded != run.dataset) grid.emplace(load_dataset(experiment.datasets[run.dataset], ""));
    loaded = run.dataset;
    const RunInput input{
        .path = dataset_path(experiment.datasets[run.dataset], ""), .grid = *grid, .stop = stop, .progress = {}};
    std::optional<Json> record = run_and_record(experiment, run, input);
    if (!record) throw InputError("explain: stopped while the experiments of the page were made; nothing is written");
    records.push_back(*std::move(record));
  }
  return records;
}

Json rows_of(const Table& table) {
  Json rows = Json::array();
  for (const TableRow& row : table.rows) {
    Json cells = Json::array();
    for (const TableCell& cell : row.cells) {
      cells.push_back({{"text", spread_text(cell.ours)}, {"numbers", cell.ours.numbers}});
    }
    rows.push_back({{"dataset", row.dataset}, {"variant", row.variant}, {"cells", std::move(cells)}});
  }
  return rows;
}

// What the answers say of figures: the page asks for it before it shows them.
Json claims_of(const Experiment& experiment) {
  Json claims = Json::array();
  for (const Answer& answer : experiment.answers) {
    for (const Claim& claim : answer.holds) {
      claims.push_back({{"figure", claim.figure},
                        {"is", kRelationNames[static_cast<std::size_t>(claim.relation)]},
                        {"than", claim.than}});
    }
  }
  return claims;
}

Json lesson_experiment(const LessonModule& module, const std::atomic<bool>* stop) {
  const std::string file(module.name.substr(module.name.find("configs/")));
  const Experiment experiment = parse_experiment(parse_json(std::string(module.text), file), file);
  const Table table = make_table(experiment, records_of(experiment, stop));
  const AnswerText answer = answer_text(experiment, table);
  Json metrics = Json::array();
  for (const Metric& metric : experiment.metrics) metrics.push_back(metric.name);
  return {{"file", file},
          {"title", experiment.title},
          {"question", experiment.question},
          {"notes", experiment.notes},
          {"metrics", std::move(metrics)},
          {"rows", rows_of(table)},
          {"claims", claims_of(experiment)},
          {"answer", answer.markdown},
          {"untrue", answer.untrue}};
}

}  // namespace

Json lesson_experiments(const std::atomic<bool>* stop) {
  Json all = Json::array();
  for (const LessonModule& module : lesson_modules()) {
    if (module.name.ends_with(".json")) all.push_back(lesson_experiment(module, stop));
  }
  return all;
}

}  // namespace deliso
