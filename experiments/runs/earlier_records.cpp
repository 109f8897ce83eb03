#include "experiments/runs/earlier_records.h"

#include <algorithm>
#include <map>
#include <set>

#include "delaunay/base/check.h"
#include "experiments/config/config.h"
#include "experiments/runs/experiment_datasets.h"
#include "experiments/runs/record.h"
#include "experiments/runs/record_file.h"
#include "experiments/runs/run_record.h"
#include "experiments/system/files.h"
#include "volume/io/sha256.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// What must agree, but for the volume.
Json identity(const Experiment& experiment, const PlannedRun& run) {
  const Variant& variant = experiment.variants[run.variant];
  const bool is_mesh = experiment.task == Task::kMesh;
  return Json{{"kind", is_mesh ? mesher_json(variant) : Json("topology")},
              {"parameters", is_mesh ? parameters_to_json(variant.parameters) : Json()},
              {"isovalue", experiment.datasets[run.dataset].isovalue},
              {"seed", seed_of(experiment, run.repeat)},
              {"program", program_json()}};
}

Json part(const Json& record, const char* key) { return record.contains(key) ? record[key] : Json(); }

Json identity(const Json& record) {
  const bool is_mesh = !record.contains("isosurface");
  Json kind = record.contains("mesher") ? record["mesher"] : Json("deliso");
  Json parameters = part(record, "parameters");
  if (!is_mesh) kind = "topology";
  return Json{{"kind", kind},
              {"parameters", parameters},
              {"isovalue", part(record, "isovalue")},
              {"seed", part(record, "seed")},
              {"program", part(record, "program")}};
}

// The machine is no part of the program. Numbers compare by value, 1 and 1.0 alike.
std::string identity_key(Json identity) {
  if (identity["program"].is_object()) identity["program"].erase("cpu");
  if (identity["isovalue"].is_number()) identity["isovalue"] = identity["isovalue"].get<double>();
  return json_line(identity);
}

std::string own_name(const Json& record) { return json_line(record.at("experiment")) + run_key(record); }

class Matcher {
 public:
  Matcher(const Experiment& experiment, const fs::path& data_folder, std::vector<Json> records)
      : experiment_(experiment),
        data_folder_(data_folder),
        records_(std::move(records)),
        is_taken_(records_.size(), 0),
        sha256_(experiment.datasets.size()) {
    for (std::size_t i = 0; i < records_.size(); ++i) by_key_[identity_key(identity(records_[i]))].push_back(i);
  }

  EarlierRecords match() {
    EarlierRecords earlier;
    const std::vector<PlannedRun> runs = planned_runs(experiment_);
    earlier.by_run.resize(runs.size());
    // First every record goes to the run whose names it bears, then what is left to runs under other names.
    for (const bool by_name : {true, false}) {
      for (std::size_t i = 0; i < runs.size(); ++i) {
        if (!earlier.by_run[i]) earlier.by_run[i] = take(runs[i], by_name);
        if (!earlier.by_run[i] && !by_name) earlier.pending.push_back(runs[i]);
      }
    }
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (is_taken_[i] == 0) earlier.unused.push_back(std::move(records_[i]));
    }
    return earlier;
  }

 private:
  std::optional<Json> take(const PlannedRun& run, bool by_name) {
    const Json header = run_header(experiment_, run, kStatusDone);
    const auto candidates = by_key_.find(identity_key(identity(experiment_, run)));
    if (candidates == by_key_.end()) return std::nullopt;
    for (const std::size_t i : candidates->second) {
      const Json& record = records_[i];
      if (is_taken_[i] != 0 || (by_name && own_name(record) != own_name(header))) continue;
      if (experiment_.distances && !(record.contains("distances") && record.contains("verification"))) continue;
      if (!is_of_volume(record, run.dataset)) continue;
      is_taken_[i] = 1;
      Json taken = record;
      for (const auto& [key, value] : header.items()) taken[key] = value;
      return taken;
    }
    return std::nullopt;
  }

  bool is_of_volume(const Json& record, std::size_t dataset) {
    const Dataset& of_run = experiment_.datasets[dataset];
    if (!is_present(of_run, data_folder_) && of_run.sha256.empty()) return record.at("dataset") == of_run.name;
    const Json volume = part(record, "volume");
    return volume.is_object() && part(volume, "sha256") == sha256_of(dataset);
  }

  // Of the samples, found once; empty when they cannot be read.
  const std::string& sha256_of(std::size_t dataset) {
    std::optional<std::string>& known = sha256_[dataset];
    if (known) return *known;
    known = experiment_.datasets[dataset].sha256;
    if (!known->empty()) return *known;
    try {
      known = sample_sha256(load_dataset(experiment_.datasets[dataset], data_folder_));
    } catch (const InputError&) {
      known = "";  // the run will tell
    }
    return *known;
  }

  const Experiment& experiment_;
  const fs::path& data_folder_;
  std::vector<Json> records_;
  std::vector<char> is_taken_;
  std::map<std::string, std::vector<std::size_t>> by_key_;
  std::vector<std::optional<std::string>> sha256_;
};

// The finished records of a file. What a crash cut off is left out.
void read_finished(const fs::path& file, std::vector<Json>& records, std::set<std::string>& seen) {
  std::vector<std::string> notes;
  for (Json& record : read_records(file, notes)) {
    if (record["status"] == kStatusDone && seen.insert(record.dump()).second) records.push_back(std::move(record));
  }
}

void append_lines(std::string& text, const Json& record) { text += json_line(record) + '\n'; }

}  // namespace

EarlierRecords find_earlier_records(const Experiment& experiment, const fs::path& data_folder,
                                    const fs::path& out_folder) {
  std::vector<Json> records;
  std::set<std::string> seen;
  std::error_code error;
  if (!fs::is_directory(out_folder, error)) {
    EarlierRecords none;
    none.pending = planned_runs(experiment);
    none.by_run.resize(none.pending.size());
    return none;
  }
  for (const fs::path& file : record_files(out_folder)) read_finished(file, records, seen);
  const std::size_t in_use = records.size();
  const fs::path unused = out_folder / kUnusedRecordsFile;
  if (fs::exists(unused, error)) read_finished(unused, records, seen);
  const std::set<std::string> before = [&] {
    std::set<std::string> names;
    for (std::size_t i = 0; i < in_use; ++i) names.insert(records[i].dump());
    return names;
  }();
  EarlierRecords earlier = Matcher(experiment, data_folder, std::move(records)).match();
  // The files stay as they are where every record in use goes on as it is, and none of them is left over.
  std::size_t same = 0;
  std::size_t taken = 0;
  for (const std::optional<Json>& record : earlier.by_run) {
    if (record) ++taken;
    if (record && before.contains(record->dump())) ++same;
  }
  earlier.is_moved = same != taken || same != in_use;
  return earlier;
}

void move_records(const EarlierRecords& earlier, const fs::path& out_folder) {
  // First what would be lost otherwise; a record that is in two files after a crash counts once.
  std::string text;
  for (const Json& record : earlier.unused) append_lines(text, record);
  if (!text.empty()) write_text(text, out_folder / kUnusedRecordsFile);
  text.clear();
  for (const std::optional<Json>& record : earlier.by_run) {
    if (record) append_lines(text, *record);
  }
  const fs::path records = out_folder / record_file_name({});
  write_text(text, records);
  std::error_code error;
  for (const fs::path& file : record_files(out_folder)) {
    if (file != records) fs::remove(file, error);
  }
  if (earlier.unused.empty()) fs::remove(out_folder / kUnusedRecordsFile, error);
}

}  // namespace deliso
