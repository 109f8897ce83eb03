// deliso table: tables and plots from the records of an experiment.
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/results/comparison.h"
#include "experiments/results/results.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"

namespace deliso {
namespace {

struct TableCommandOptions {
  std::vector<std::string> folders;
  std::string output;
  std::string experiment;
  std::string by;
  bool answers = false;
};

void check_experiment_stays(const TableCommandOptions& options, const Experiment& experiment,
                            const std::filesystem::path& target) {
  check_distinct({{"--experiment", options.experiment}}, result_files(experiment, "-o", target));
}

// Records of several programs, which need not be of the same experiment: the words and metrics are those of the first.
ExitCode run_comparison(const TableCommandOptions& options, const std::vector<std::filesystem::path>& folders,
                        const std::filesystem::path& target) {
  if (std::find(kComparedBy.begin(), kComparedBy.end(), options.by) == kComparedBy.end()) {
    throw InputError("--by: expected commit, version, compiler, flags or cpu, found '" + options.by + "'");
  }
  if (options.answers) throw InputError("--answers: a comparison has none; leave out --by or --answers");
  const Experiment experiment =
      options.experiment.empty() ? experiment_of({folders.front()}) : read_experiment(options.experiment);
  check_experiment_stays(options, experiment, target);
  std::cout << write_comparison(experiment, folders, target, options.by);
  return ExitCode::kDone;
}

ExitCode run_table(const TableCommandOptions& options) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  const std::filesystem::path target = options.output.empty() ? folders.front() : std::filesystem::path(options.output);
  if (!options.by.empty()) return run_comparison(options, folders, target);
  Experiment experiment = experiment_of(folders);
  if (!options.experiment.empty()) experiment = experiment_for_records(options.experiment, experiment);
  check_experiment_stays(options, experiment, target);
  std::vector<std::string> notes;
  const PrintedTable printed = write_tables(experiment, folders, target, options.answers, notes);
  std::cout << printed.markdown;
  for (const std::string& note : notes) std::cerr << "deliso: " << note << '\n';
  for (const std::string& untrue : printed.untrue) std::cerr << "deliso: the answer does not hold: " << untrue << '\n';
  return printed.untrue.empty() ? ExitCode::kDone : ExitCode::kNotProven;
}

}  // namespace

void add_table_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<TableCommandOptions>();
  Command command = line.add_command(
      "table", "Make tables (Markdown, CSV, JSON, LaTeX) and plots (SVG, a script) from the records of a run");
  command.add_option("OUT_DIR", options->folders, "Folders with records of one experiment, of any number of shards")
      .type_name("")
      .required()
      .check(refuse_empty_name);
  command
      .add_option("-o,--output", options->output,
                  "Folder for table.md, table.csv, table.json and the plots (default: the first)")
      .type_name("DIR")
      .check(refuse_empty_name);
  command
      .add_option("--experiment", options->experiment,
                  "Take words, metrics and plots from this file; its runs must be those of the records")
      .type_name("FILE")
      .check(refuse_empty_name);
  command
      .add_option(
          "--by", options->by,
          "Compare the programs of the records by commit, version, compiler, flags or cpu: ratios to the first, "
          "paired by data set, variant and seed, with intervals")
      .type_name("KEY")
      .check(refuse_empty_value);
  command.add_flag("--answers", options->answers,
                   "Below the table, print the answer to the experiment's question and compare it with the records");
  command.examples(
      "deliso table out/table3\n"
      "deliso table out/table3-1 out/table3-2 -o out/table3\n"
      "deliso table out/before out/after --by commit",
      "The table has a column for each metric of the experiment. Its plots are NAME.svg: curves of one metric\n"
      "against another, bars of a row's parts, or histograms of counts; the key 'plots' of the experiment names them.\n"
      "Exit code 1 with --answers: the records do not show what the answer says.");
  command.callback(exit_code, [options] { return run_table(*options); });
}

}  // namespace deliso
