#include "experiments/results/results.h"

#include <array>
#include <string_view>
#include <system_error>

#include "delaunay/base/check.h"
#include "experiments/results/answers.h"
#include "experiments/results/comparison.h"
#include "experiments/results/plot.h"
#include "experiments/results/table.h"
#include "experiments/results/table_files.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/record_file.h"
#include "experiments/system/files.h"

namespace deliso {

namespace fs = std::filesystem;

namespace {

void make_target(const fs::path& target) {
  std::error_code error;
  fs::create_directories(target, error);
  if (error) throw InputError("cannot make the folder " + target.string() + ": " + error.message());
}

}  // namespace

std::vector<NamedFile> result_files(const Experiment& experiment, const std::string& option, const fs::path& folder) {
  constexpr std::array<std::string_view, 9> kNames{"table.md",       "table.csv",       "table.json",
                                                   "table.tex",      "table.py",        "comparison.md",
                                                   "comparison.csv", "comparison.json", "comparison.tex"};
  std::vector<NamedFile> files;
  files.reserve(kNames.size() + experiment.plots.size());
  for (const std::string_view name : kNames) files.push_back({option, folder / name});
  for (const Plot& plot : experiment.plots) files.push_back({option, folder / svg_name(plot)});
  return files;
}

Experiment experiment_of(const std::vector<fs::path>& folders) {
  const fs::path first = folders.front() / "experiment.json";
  const Json document = read_json(first);
  for (const fs::path& folder : folders) {
    if (read_json(folder / "experiment.json") != document) {
      throw InputError((folder / "experiment.json").string() + ": is another experiment than " + first.string());
    }
  }
  return parse_experiment(document, first);
}

Experiment experiment_for_records(const fs::path& file, const Experiment& recorded) {
  Experiment experiment = read_experiment(file);
  if (recorded.name == experiment.name + "_builtin") experiment = builtin_form(std::move(experiment));
  const std::string refusal = "--experiment: " + file.string() + " is not the experiment of these records: ";
  if (experiment.name != recorded.name) {
    const bool named = read_json(file).contains("name");
    throw InputError(refusal + "its name is '" + experiment.name + "' (" +
                     (named ? "its key 'name'" : "that of the file, for it has no key 'name'") + "), theirs is '" +
                     recorded.name + "'");
  }
  // Titles, metrics, plots and published figures may differ; what was run may not.
  Json now = experiment_to_json(experiment);
  Json then = experiment_to_json(recorded);
  for (const char* key :
       {"title", "question", "notes", "answers", "rows", "metrics", "plots", "reference", "builtin_datasets"}) {
    now.erase(key);
    then.erase(key);
  }
  for (const auto& [key, value] : then.items()) {
    if (now[key] != value) {
      throw InputError(std::string(refusal).append("its key '").append(key).append("' differs"));
    }
  }
  return experiment;
}

PrintedTable write_tables(const Experiment& experiment, const std::vector<fs::path>& folders, const fs::path& target,
                          bool answers, std::vector<std::string>& notes) {
  const std::vector<Json> records = merge_records(experiment, folders, notes);
  const Table table = make_table(experiment, records);
  PrintedTable printed{table_markdown(experiment, table), {}};
  const AnswerText answer = answers ? answer_text(experiment, table) : AnswerText();
  make_target(target);
  write_text(printed.markdown, target / "table.md");
  write_text(table_csv(experiment, table), target / "table.csv");
  write_text(json_text(table_json(experiment, table)), target / "table.json");
  write_text(table_latex(experiment, table), target / "table.tex");
  write_text(table_script(experiment), target / "table.py");
  for (const PlotFile& plot : draw_plots(experiment, table, records)) write_text(plot.svg, target / plot.name);
  printed.markdown += answer.markdown;
  printed.untrue = answer.untrue;
  return printed;
}

std::string write_comparison(const Experiment& experiment, const std::vector<fs::path>& folders, const fs::path& target,
                             const std::string& by) {
  const Comparison comparison = compare_programs(experiment, folders, by);
  make_target(target);
  std::string markdown = comparison_markdown(experiment, comparison);
  write_text(markdown, target / "comparison.md");
  write_text(comparison_csv(experiment, comparison), target / "comparison.csv");
  write_text(json_text(comparison_json(experiment, comparison)), target / "comparison.json");
  write_text(comparison_latex(experiment, comparison), target / "comparison.tex");
  return markdown;
}

}  // namespace deliso
