// Records of earlier runs that serve an experiment as it is now, whatever it was called or said before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// Holds records that no run of the experiment needs, for the day when one does.
inline constexpr const char* kUnusedRecordsFile = "unused.jsonl";

struct EarlierRecords {
  std::vector<PlannedRun> pending;          // the planned runs without a record, in their order
  std::vector<std::optional<Json>> by_run;  // for each planned run its record, under its present names
  std::vector<Json> unused;                 // finished records of no run
  bool is_moved = false;                    // whether the folder's files are to be written anew for this
};

// Matches the finished records of a results folder with the runs. A record serves a run when both agree in task or
// mesher, resolved parameters, isovalue, SHA-256 of the samples, seed and program (version, commit, compiler, flags),
// and when it has the measures that the experiment asks for. It serves one run; one of its own names goes first. A
// volume that is absent is taken for the one of the same name.
EarlierRecords find_earlier_records(const Experiment& experiment, const std::filesystem::path& data_folder,
                                    const std::filesystem::path& out_folder);

// Puts the records into the folder's files: those in use into records.jsonl, the others into kUnusedRecordsFile.
void move_records(const EarlierRecords& earlier, const std::filesystem::path& out_folder);

}  // namespace deliso
