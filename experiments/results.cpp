#include "experiments/results.h"

#include <system_error>

#include "delaunay/base/check.h"
#include "experiments/experiment_config.h"
#include "experiments/files.h"
#include "experiments/plot.h"
#include "experiments/record_file.h"
#include "experiments/table.h"

namespace deliso {

namespace fs = std::filesystem;

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

std::string write_tables(const std::vector<fs::path>& folders, const fs::path& target,
                         std::vector<std::string>& notes) {
  const Experiment experiment = experiment_of(folders);
  const std::vector<Json> records = merge_records(folders, notes);
  const Table table = make_table(experiment, records);
  std::string markdown = table_markdown(experiment, table);
  std::error_code error;
  fs::create_directories(target, error);
  if (error) throw InputError("cannot make the folder " + target.string() + ": " + error.message());
  write_text(markdown, target / "table.md");
  write_text(table_csv(experiment, table), target / "table.csv");
  write_text(json_text(table_json(experiment, table)), target / "table.json");
  for (const PlotFile& plot : draw_plots(experiment, table, records)) write_text(plot.svg, target / plot.name);
  return markdown;
}

}  // namespace deliso
