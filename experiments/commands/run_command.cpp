// deliso run: an experiment from a JSON file.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/results/results.h"
#include "experiments/runs/answer_config.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/run_progress.h"
#include "experiments/runs/runner.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/progress_bar.h"
#include "experiments/system/stop_signal.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

struct RunCommandOptions {
  std::string experiment;
  std::string data;
  std::string out;
  std::string shard = "1/1";
  std::string threads = "1";
  std::string jobs = "1";
  bool resume = false;
  bool dry_run = false;
  bool builtin = false;
  bool smoke = false;
  bool progress = false;
  bool quiet = false;
};

// The plan: one line for each run still to be made.
void print_plan(const Experiment& experiment, const RunnerOptions& options) {
  for (const PlannedRun& run : pending_runs(experiment, options)) {
    const bool present = is_present(experiment.datasets[run.dataset], options.data_folder);
    std::cout << run_name(experiment, run) << ", seed " << seed_of(experiment, run.repeat)
              << (present ? "" : " (absent)") << '\n';
  }
  for (const Dataset& dataset : experiment.datasets) {
    if (!is_present(dataset, options.data_folder)) {
      std::cerr << "deliso: absent: " << absent_text(dataset, options.data_folder) << '\n';
    }
  }
}

ExitCode report(const RunnerSummary& summary, const RunnerOptions& options, bool quiet) {
  for (const std::string& failure : summary.failed) std::cerr << "deliso: failed: " << failure << '\n';
  if (!quiet) {
    for (const std::string& absent : summary.absent) std::cerr << "deliso: absent: " << absent << '\n';
  }
  if (summary.stopped) {
    std::cerr << "deliso: stopped after " << summary.done_before + summary.done << " of " << summary.planned
              << " runs; --resume goes on with " << options.out_folder.string() << '\n';
    return ExitCode::kStopped;
  }
  return summary.failed.empty() ? ExitCode::kDone : ExitCode::kNotProven;
}

// The default folder may be missing: then its data sets are absent. A folder that was named must exist.
fs::path data_folder(const RunCommandOptions& options) {
  if (options.data.empty()) return default_data_folder(options.experiment);
  std::error_code error;
  if (!fs::is_directory(options.data, error)) {
    throw InputError("--data: expected a folder with the volumes, found " +
                     (fs::exists(options.data, error) ? options.data + ", which is no folder"
                                                      : "no folder of the name " + options.data));
  }
  return options.data;
}

// The experiment's file may be the folder's own, which stays as it is, but nothing that takes its place.
void check_experiment_stays(const RunCommandOptions& options, const Experiment& experiment, const fs::path& folder) {
  std::vector<NamedFile> outputs = result_files(experiment, "--out", folder);
  if (read_text(options.experiment) != json_text(experiment_to_json(experiment)))
    outputs.push_back({"--out", folder / "experiment.json"});
  check_distinct({{"EXPERIMENT", options.experiment}}, outputs);
}

ExitCode run_run(const RunCommandOptions& options) {
  // The experiment and every option are checked before the first run.
  Experiment experiment = read_experiment(options.experiment);
  if (options.builtin) experiment = builtin_form(std::move(experiment));
  if (options.smoke) experiment = smoke_form(std::move(experiment));
  RunnerOptions runner;
  runner.data_folder = data_folder(options);
  runner.out_folder = options.out.empty() ? fs::path("out") / experiment.name : fs::path(options.out);
  check_experiment_stays(options, experiment, runner.out_folder);
  runner.shard = parse_shard(options.shard);
  runner.threads = parse_threads(options.threads);
  constexpr std::uint64_t kMostJobs = 1024;
  runner.jobs = static_cast<int>(parse_count(options.jobs, "--jobs", 1, kMostJobs));
  runner.resume = options.resume;
  if (options.dry_run) {
    print_plan(experiment, runner);
    return ExitCode::kDone;
  }
  runner.stop = &catch_stop_signals();

  // A question that has an answer is to be thought about while the runs are made.
  if (!experiment.answers.empty() && !options.quiet) std::cerr << "deliso: question: " << experiment.question << '\n';
  const std::string left_out = unknown_variants_remark(experiment.answers);
  if (!left_out.empty()) std::cerr << "deliso: " << left_out << '\n';

  // Do the runs, with progress on a terminal.
  using Style = RunProgress::Style;
  Style style = stderr_is_terminal() ? Style::kBar : Style::kSilent;
  if (options.progress) style = Style::kLines;
  if (options.quiet) style = Style::kSilent;
  RunProgress progress(std::cerr, style);
  const RunnerSummary summary = run_experiment(experiment, runner, progress);
  const ExitCode exit_code = report(summary, runner, options.quiet);

  // A single shard gives no complete table yet.
  if (runner.shard.count == 1 && !summary.stopped) {
    std::vector<std::string> notes;
    std::cout << write_tables(experiment, {runner.out_folder}, runner.out_folder, false, notes).markdown;
    for (const std::string& note : notes) std::cerr << "deliso: " << note << '\n';
  }
  return exit_code;
}

}  // namespace

void add_run_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<RunCommandOptions>();
  Command command = line.add_command("run", "Do an experiment and make its table and plots");
  command.add_option("EXPERIMENT", options->experiment, "The experiment: a JSON file (configs/paper/table3.json)")
      .type_name("")
      .required()
      .check(refuse_empty_name);
  command.add_option("--data", options->data, "Folder with the volumes (default: $DELISO_DATA, else data/)")
      .type_name("DIR")
      .check(refuse_empty_name);
  command.add_option("--out", options->out, "Folder for records, tables and plots (default: out/NAME)")
      .type_name("DIR")
      .check(refuse_empty_name);
  command.add_option("--shard", options->shard, "Do the I-th of N parts of the runs alone")
      .type_name("I/N")
      .show_default();
  command.add_option("--threads", options->threads, "Threads to use in each run").type_name("N").show_default();
  command
      .add_option("--jobs", options->jobs,
                  "Runs to make at a time, each in a process of its own; marks times as shared")
      .type_name("N")
      .show_default();
  command.add_flag(
      "--resume", options->resume,
      "Take every record in the folder that still holds, whatever the config said then: parameters, volume, "
      "seed and program agree");
  command.add_flag("--dry-run", options->dry_run, "List the runs that would be made");
  command.add_flag("--builtin", options->builtin, "Take the experiment's built-in fields, which need no file");
  command.add_flag("--smoke", options->smoke, "Do every variant once on one tiny field: does the experiment work?");
  command.add_flag("--progress", options->progress, "A line on stderr for every run that ends (for log files)");
  command.add_flag("--quiet", options->quiet, "No progress and no remarks on stderr");
  command.examples(
      "deliso run configs/paper/table3.json --data volumes --out out/table3\n"
      "deliso run configs/bench/volume_size.json --builtin --dry-run",
      "A volume that is absent is listed as absent, with the way to get it, and is no failure.\n"
      "Exit codes: 0 every run was made, or is absent; 1 a run failed; 3 stopped, --resume goes on.");
  command.callback(exit_code, [options] { return run_run(*options); });
}

}  // namespace deliso
