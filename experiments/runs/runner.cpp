#include "experiments/runs/runner.h"

#include <exception>
#include <new>
#include <optional>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/stopwatch.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/record_file.h"
#include "experiments/runs/run_lock.h"
#include "experiments/runs/run_record.h"
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

// Writes the experiment into the out folder, unless it is there already.
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
    if (has_records) {
      read_json(file);  // a damaged file is reported as such
      throw InputError("--out: " + options.out_folder.string() +
                       " holds records of another experiment, or of another state of this one; name another folder");
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
                            VolumeCache& volumes, RunProgress& progress) {
  const Dataset& dataset = experiment.datasets[run.dataset];
  try {
    const RunInput input{dataset_path(dataset, options.data_folder), volumes.load(dataset), options.threads,
                         options.stop, [&progress](const Progress& state) { progress.show(state); }};
    return run_and_record(experiment, run, input);
  } catch (const std::bad_alloc&) {
    return failed_record(experiment, run, "not enough memory for this volume and these parameters");
  } catch (const std::exception& error) {
    return failed_record(experiment, run, error.what());
  }
}

}  // namespace

std::string run_name(const Experiment& experiment, const PlannedRun& run) {
  return experiment.datasets[run.dataset].name + ", " + experiment.variants[run.variant].name + ", repeat " +
         std::to_string(run.repeat);
}

std::string absent_text(const Dataset& dataset, const fs::path& data_folder) {
  return dataset.name + ": " + dataset.file + " is not in " + data_folder.string() + "; " + dataset.get;
}

std::vector<PlannedRun> pending_runs(const Experiment& experiment, const RunnerOptions& options) {
  std::vector<PlannedRun> runs = runs_of(experiment, options.shard);
  std::error_code error;
  if (!options.resume || !fs::exists(options.out_folder, error)) return runs;
  std::set<std::string> done;
  std::vector<std::string> notes;
  for (const Json& record : merge_records(experiment, {options.out_folder}, notes)) {
    if (record["status"] == kStatusDone) done.insert(run_key(record));
  }
  std::erase_if(runs, [&](const PlannedRun& run) { return done.contains(run_key(experiment, run)); });
  return runs;
}

RunnerSummary run_experiment(const Experiment& experiment, const RunnerOptions& options, RunProgress& progress) {
  // Find the runs that are left to do, and make sure that no other process is doing them.
  make_folder(options.out_folder);
  const RunLock lock(options.out_folder, options.shard, planned_runs(experiment).size());
  prepare_folder(experiment, options);
  const std::vector<PlannedRun> runs = pending_runs(experiment, options);
  RunnerSummary summary;
  summary.planned = runs_of(experiment, options.shard).size();
  summary.done_before = summary.planned - runs.size();
  RecordFile records(options.out_folder / record_file_name(options.shard));
  VolumeCache volumes(options.data_folder);
  std::set<std::size_t> absent;

  for (const PlannedRun& run : runs) {
    if (options.stop != nullptr && options.stop->load()) {
      summary.stopped = true;
      break;
    }
    // A missing data set is recorded as absent, with the way to get it.
    const Dataset& dataset = experiment.datasets[run.dataset];
    if (!is_present(dataset, options.data_folder)) {
      Json record = run_header(experiment, run, kStatusAbsent);
      record["get"] = dataset.get;
      records.append(record);
      if (absent.insert(run.dataset).second) summary.absent.push_back(absent_text(dataset, options.data_folder));
      progress.skipped();
      continue;
    }
    // Do the run and write its record.
    progress.begin(run_name(experiment, run));
    const Stopwatch stopwatch;
    const std::optional<Json> record = attempt(experiment, run, options, volumes, progress);
    if (!record) {
      summary.stopped = true;
      break;
    }
    records.append(*record);
    if (record->at("status") == kStatusFailed) {
      summary.failed.push_back(run_name(experiment, run) + ": " + record->at("error").get<std::string>());
    } else {
      ++summary.done;
    }
    progress.finished(stopwatch.seconds());
  }
  progress.wipe();
  return summary;
}

}  // namespace deliso
