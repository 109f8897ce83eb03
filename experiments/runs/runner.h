// Does the runs of an experiment, one after the other or several at a time, and writes each record as its run ends.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runs/experiment.h"
#include "experiments/runs/run_progress.h"

namespace deliso {

struct RunnerOptions {
  std::filesystem::path data_folder;
  std::filesystem::path out_folder;  // created if necessary
  Shard shard;
  bool resume = false;  // take the records in the folder that still hold
  std::int32_t threads = 1;
  int jobs = 1;  // runs at a time, each in a process of its own when there are several
  const std::atomic<bool>* stop = nullptr;
};

struct RunnerSummary {
  std::size_t planned = 0;  // runs of this shard
  std::size_t done_before = 0;
  std::size_t done = 0;
  std::vector<std::string> failed;  // one sentence for each run that failed
  std::vector<std::string> absent;  // one sentence for each data set whose file is absent
  bool stopped = false;
};

// Throws InputError when the out folder holds another experiment, holds records although `resume` is off, or cannot be
// written, or when another process is making these runs in it. A run that fails (also because its file is not the
// expected data set) is recorded as failed, and the next run begins. `resume` takes every record that still holds,
// whatever the config said when it was made (earlier_records.h); it repeats failed runs, and runs whose data sets were
// absent.
RunnerSummary run_experiment(const Experiment& experiment, const RunnerOptions& options, RunProgress& progress);

// The runs of the shard that `resume` would still make: those without a finished record in the out folder.
std::vector<PlannedRun> pending_runs(const Experiment& experiment, const RunnerOptions& options);

// "FUEL, paper, repeat 2".
std::string run_name(const Experiment& experiment, const PlannedRun& run);

// "LEG: leg.nrrd is not in DIR; get it from ...".
std::string absent_text(const Dataset& dataset, const std::filesystem::path& data_folder);

}  // namespace deliso
