#include "experiments/runs/runner.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/stopwatch.h"
#include "experiments/runs/earlier_records.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/record_file.h"
#include "experiments/runs/run_lock.h"
#include "experiments/runs/run_record.h"
#include "experiments/runs/run_workers.h"
#include "experiments/system/files.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

bool holds_records(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& file : record_files(folder)) {
    if (fs::file_size(file, error) > 0) return true;
  }
  return false;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--out: cannot make the folder " + folder.string() + ": " + error.message());
}

// Writes the experiment into the out folder, unless it is there already. With `resume` it may be another one.
void prepare_folder(const Experiment& experiment, const RunnerOptions& options) {
  std::error_code error;
  const bool has_records = holds_records(options.out_folder);
  const fs::path file = options.out_folder / "experiment.json";
  const std::string text = json_text(experiment_to_json(experiment));
  if (fs::exists(file, error)) {
    if (read_text(file) == text) {
      // Shards may share a folder: existing records of other shards do no harm.
      const fs::path own = options.out_folder / record_file_name(options.shard);
      const bool has_own = fs::exists(own, error) && fs::file_size(own, error) > 0;
      if (!options.resume && (has_own || (has_records && options.shard.count == 1))) {
        throw InputError("--out: " + options.out_folder.string() +
                         " holds records of this experiment already; --resume goes on with them");
      }
      return;
    }
    if (has_records && !options.resume) {
      read_json(file);  // a damaged file is reported as such
      throw InputError("--out: " + options.out_folder.string() +
                       " holds records of another experiment, or of another state of this one; --resume takes those " +
                       "that still hold, or name another folder");
    }
  } else if (has_records) {
    throw InputError("--out: " + options.out_folder.string() + " holds records but no experiment.json");
  }
  write_text(text, file);
}

// Keeps the volume of the previous run, or its error: runs of one data set follow each other.
class VolumeCache {
 public:
  explicit VolumeCache(fs::path data_folder) : data_folder_(std::move(data_folder)) {}

  // Throws what load_dataset throws, each time.
  const ScalarGrid& load(const Dataset& dataset) {
    if (name_ != dataset.name) {
      name_ = dataset.name;
      fault_ = nullptr;
      grid_.reset();  // freed first: two large volumes need not fit into memory at once
      try {
        grid_.emplace(load_dataset(dataset, data_folder_));
      } catch (...) {
        fault_ = std::current_exception();
      }
    }
    if (fault_) std::rethrow_exception(fault_);
    return *grid_;
  }

 private:
  fs::path data_folder_;
  std::string name_;
  std::optional<ScalarGrid> grid_;
  std::exception_ptr fault_;
};

Json failed_record(const Experiment& experiment, const PlannedRun& run, const std::string& error) {
  Json record = run_header(experiment, run, kStatusFailed);
  record["error"] = error;
  return record;
}

// A record of the run: done or failed (also when its volume is not the expected one); nothing when it was stopped.
std::optional<Json> attempt(const Experiment& experiment, const PlannedRun& run, const RunnerOptions& options,
                            VolumeCache& volumes, RunProgress& progress, ProgramLauncher* launcher) {
  const Dataset& dataset = experiment.datasets[run.dataset];
  try {
    const RunInput input{dataset_path(dataset, options.data_folder),
                         volumes.load(dataset),
                         options.threads,
                         options.stop,
                         [&progress](const Progress& state) { progress.show(state); },
                         launcher};
    return run_and_record(experiment, run, input);
  } catch (const std::bad_alloc&) {
    return failed_record(experiment, run, "not enough memory for this volume and these parameters");
  } catch (const std::exception& error) {
    return failed_record(experiment, run, error.what());
  }
}

std::vector<PlannedRun> pending_of(const Experiment& experiment, const RunnerOptions& options,
                                   const EarlierRecords& earlier) {
  std::set<std::string> pending;
  for (const PlannedRun& run : earlier.pending) pending.insert(run_key(experiment, run));
  std::vector<PlannedRun> runs = runs_of(experiment, options.shard);
  std::erase_if(runs, [&](const PlannedRun& run) { return !pending.contains(run_key(experiment, run)); });
  return runs;
}

// A lock on the runs that the lock of this shard leaves free; none where the shard is the whole.
std::optional<RunLock> lock_other_shards(const Experiment& experiment, const RunnerOptions& options) {
  if (options.shard.count == 1) return std::nullopt;
  return std::optional<RunLock>(std::in_place, options.out_folder, options.shard, planned_runs(experiment).size(),
                                RunLock::Part::kOthers);
}

// Makes runs and keeps their records.
class ExperimentRuns {
 public:
  ExperimentRuns(const Experiment& experiment, const RunnerOptions& options, RunProgress& progress)
      : experiment_(experiment),
        options_(options),
        progress_(progress),
        records_(options.out_folder / record_file_name(options.shard)) {
    // Before volumes are loaded here.
    if (options.jobs == 1) begin_process();
  }

  RunnerSummary make(const std::vector<PlannedRun>& runs, std::size_t planned) {
    summary_.planned = planned;
    summary_.done_before = planned - runs.size();
    const std::vector<PlannedRun> present = without_absent(runs);
    std::vector<std::size_t> datasets;
    datasets.reserve(present.size());
    for (const PlannedRun& run : present) datasets.push_back(run.dataset);
    progress_.plan(std::move(datasets));
    if (options_.jobs == 1) {
      one_by_one(present);
    } else {
      side_by_side(present);
    }
    progress_.wipe();
    return std::move(summary_);
  }

 private:
  ProgramLauncher* launcher() { return launcher_ ? &*launcher_ : nullptr; }
  [[nodiscard]] bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  // A missing data set is recorded as absent, with the way to get it.
  std::vector<PlannedRun> without_absent(const std::vector<PlannedRun>& runs) {
    std::vector<PlannedRun> present;
    std::set<std::size_t> absent;
    for (const PlannedRun& run : runs) {
      const Dataset& dataset = experiment_.datasets[run.dataset];
      if (is_present(dataset, options_.data_folder)) {
        present.push_back(run);
        continue;
      }
      Json record = run_header(experiment_, run, kStatusAbsent);
      if (!dataset.get.empty()) record["get"] = dataset.get;
      records_.append(record);
      if (absent.insert(run.dataset).second) {
        summary_.absent.push_back(absent_text(dataset, options_.data_folder));
      }
    }
    return present;
  }

  // In each process that makes runs.
  void begin_process() {
    const auto is_command = [](const Variant& variant) { return variant.mesher == Mesher::kCommand; };
    if (std::any_of(experiment_.variants.begin(), experiment_.variants.end(), is_command)) launcher_.emplace();
  }

  void keep(const PlannedRun& run, Json record) {
    if (record["status"] == kStatusDone) record["runs_at_a_time"] = options_.jobs;
    records_.append(record);
    if (record["status"] == kStatusFailed) {
      summary_.failed.push_back(run_name(experiment_, run) + ": " + record["error"].get<std::string>());
    } else {
      ++summary_.done;
    }
  }

  void one_by_one(const std::vector<PlannedRun>& runs) {
    VolumeCache volumes(options_.data_folder);
    for (const PlannedRun& run : runs) {
      if (is_stopped()) {
        summary_.stopped = true;
        return;
      }
      progress_.begin(run_name(experiment_, run));
      const Stopwatch stopwatch;
      std::optional<Json> record = attempt(experiment_, run, options_, volumes, progress_, launcher());
      if (!record) {
        summary_.stopped = true;
        return;
      }
      keep(run, std::move(*record));
      progress_.finished(stopwatch.seconds());
    }
  }

  // In each process the volume of its last run is kept.
  void side_by_side(const std::vector<PlannedRun>& runs) {
    RunProgress silent(std::cerr, RunProgress::Style::kSilent);
    VolumeCache volumes(options_.data_folder);
    const auto make_run = [&](std::size_t index) -> std::optional<Json> {
      const Stopwatch stopwatch;
      std::optional<Json> record = attempt(experiment_, runs[index], options_, volumes, silent, launcher());
      if (record) (*record)["seconds_of_process"] = stopwatch.seconds();
      return record;
    };
    const auto is_wanted = [this] {
      summary_.stopped = summary_.stopped || is_stopped();
      return !summary_.stopped;
    };
    run_side_by_side(
        runs.size(), options_.jobs, [this] { begin_process(); }, make_run, is_wanted,
        [&](WorkerResult result) {
          const PlannedRun& run = runs[result.index];
          summary_.stopped = summary_.stopped || result.is_stopped;
          if (result.is_stopped) return;
          if (!result.record) result.record = failed_record(experiment_, run, result.failure);
          const double seconds = result.record->value("seconds_of_process", 0.0);
          result.record->erase("seconds_of_process");
          progress_.begin(run_name(experiment_, run));
          keep(run, std::move(*result.record));
          progress_.finished(seconds / options_.jobs);
        });
    summary_.stopped = summary_.stopped && summary_.done + summary_.failed.size() < runs.size();
  }

  const Experiment& experiment_;
  const RunnerOptions& options_;
  RunProgress& progress_;
  RecordFile records_;
  std::optional<ProgramLauncher> launcher_;
  RunnerSummary summary_;
};

}  // namespace

std::string run_name(const Experiment& experiment, const PlannedRun& run) {
  return experiment.datasets[run.dataset].name + ", " + experiment.variants[run.variant].name + ", repeat " +
         std::to_string(run.repeat);
}

std::string absent_text(const Dataset& dataset, const fs::path& data_folder) {
  return dataset.name + ": " + absence_text(dataset, data_folder);
}

std::vector<PlannedRun> pending_runs(const Experiment& experiment, const RunnerOptions& options) {
  if (!options.resume) return runs_of(experiment, options.shard);
  return pending_of(experiment, options, find_earlier_records(experiment, options.data_folder, options.out_folder));
}

RunnerSummary run_experiment(const Experiment& experiment, const RunnerOptions& options, RunProgress& progress) {
  // Find the runs that are left to do, and make sure that no other process is doing them.
  make_folder(options.out_folder);
  const RunLock lock(options.out_folder, options.shard, planned_runs(experiment).size());
  std::vector<PlannedRun> runs = runs_of(experiment, options.shard);
  const std::size_t planned = runs.size();
  if (options.resume) {
    const EarlierRecords earlier = find_earlier_records(experiment, options.data_folder, options.out_folder);
    if (earlier.is_moved) {
      // The files of all shards are written anew.
      const std::optional<RunLock> rest = lock_other_shards(experiment, options);
      move_records(earlier, options.out_folder);
    }
    runs = pending_of(experiment, options, earlier);
  }
  prepare_folder(experiment, options);
  return ExperimentRuns(experiment, options, progress).make(runs, planned);
}

}  // namespace deliso
