// The record of one run of an experiment: the mesher's report, and which run it was.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"
#include "experiments/system/program_launcher.h"
#include "surface/base/controls.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The outcome of a run; the key "status" of its record.
inline constexpr const char* kStatusDone = "done";
inline constexpr const char* kStatusFailed = "failed";  // "error" says why
inline constexpr const char* kStatusAbsent = "absent";  // the file of the data set is missing; "get" says how to get it

// The beginning of a run's record: schema, experiment, dataset, variant, repeat, status.
Json run_header(const Experiment& experiment, const PlannedRun& run, const std::string& status);

// What makes the mesh, as a config and a record say it: a name, or an object with the command.
Json mesher_json(const Variant& variant);

// A key that identifies a run within its experiment.
std::string run_key(const Experiment& experiment, const PlannedRun& run);
std::string run_key(const Json& record);

// The part of a record that shows it is of another experiment: "its repeat 99 is none of ..."; empty when it is of this
// one.
std::string foreign_part(const Experiment& experiment, const Json& record);

struct RunInput {
  std::filesystem::path path;  // of the volume
  const ScalarGrid& grid;
  std::int32_t threads = 1;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const Progress&)> progress;
  ProgramLauncher* launcher = nullptr;  // needed where another program makes the mesh
};

// Does the run. Returns nothing when it was stopped from outside. Throws what the mesher throws, and InputError when
// another program fails to make a mesh.
std::optional<Json> run_and_record(const Experiment& experiment, const PlannedRun& run, const RunInput& input);

// A record with all its keys and no values of a run.
const Json& empty_record(Task task, bool distances);

}  // namespace deliso
