#include "experiments/runs/record_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <sstream>

#include "delaunay/base/check.h"
#include "experiments/runs/run_record.h"
#include "experiments/system/files.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// Cuts the file after its last line end.
void drop_partial_line(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  const std::string text = read_text(path);
  const std::size_t last = text.rfind('\n');
  const std::size_t whole = last == std::string::npos ? 0 : last + 1;
  if (whole == text.size()) return;
  fs::resize_file(path, whole, error);
  if (error) throw InputError(path.string() + ": cannot remove its incomplete last line: " + error.message());
}

Json parse_record(const std::string& line, const std::string& place) {
  Json record = parse_json(line, place);
  const bool whole = record.is_object() && record.contains("experiment") && record.contains("dataset") &&
                     record.contains("variant") && record.contains("repeat") && record.contains("status") &&
                     record["dataset"].is_string() && record["variant"].is_string() &&
                     record["repeat"].is_number_integer() && record["status"].is_string();
  if (!whole) throw InputError(place + ": is no record of a run");
  return record;
}

// A record and its position: "out/records.jsonl line 3".
struct PlacedRecord {
  Json record;
  std::string place;
};

std::vector<PlacedRecord> placed_records(const fs::path& path, std::vector<std::string>& notes) {
  const std::string text = read_text(path);
  std::vector<PlacedRecord> records;
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    const std::string place = path.string() + " line " + std::to_string(number);
    if (end == std::string::npos) {
      notes.push_back(place + " is incomplete and left out");
      break;
    }
    records.push_back({parse_record(text.substr(begin, end - begin), place), place});
    begin = end + 1;
  }
  return records;
}

bool is_done(const Json& record) { return record["status"] == kStatusDone; }

// The part of a record on which two records of the same run must agree: all that is not measured in seconds or bytes.
Json outcome(const Json& record) {
  Json json = Json::object();
  for (const char* key : {"vertices", "triangles", "components", "euler_characteristic", "boundary_loops", "quality"}) {
    if (record.contains(key)) json[key] = record[key];
  }
  return json;
}

std::string run_name(const Json& record) {
  return record["dataset"].get<std::string>() + ", " + record["variant"].get<std::string>() + ", repeat " +
         record["repeat"].dump();
}

}  // namespace

RecordFile::RecordFile(fs::path path) : path_(std::move(path)) {
  drop_partial_line(path_);
  file_ = std::fopen(path_.c_str(), "ab");
  if (file_ == nullptr) throw InputError(path_.string() + ": " + std::strerror(errno));
}

RecordFile::~RecordFile() { std::fclose(file_); }

void RecordFile::append(const Json& record) {
  const std::string line = json_line(record) + '\n';
  const bool written = std::fwrite(line.data(), 1, line.size(), file_) == line.size();
  if (!written || std::fflush(file_) != 0) {
    throw InputError(path_.string() + ": writing failed: " + std::strerror(errno));
  }
  fsync(fileno(file_));  // some file systems do not support this; there the flush alone must suffice
}

std::string record_file_name(const Shard& shard) {
  if (shard.count == 1) return "records.jsonl";
  return "records." + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".jsonl";
}

std::vector<fs::path> record_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("records") && name.ends_with(".jsonl")) files.push_back(entry.path());
  }
  if (error) throw InputError(folder.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Json> read_records(const fs::path& path, std::vector<std::string>& notes) {
  std::vector<Json> records;
  for (PlacedRecord& placed : placed_records(path, notes)) records.push_back(std::move(placed.record));
  return records;
}

std::vector<Json> merge_records(const Experiment& experiment, const std::vector<fs::path>& folders,
                                std::vector<std::string>& notes) {
  std::map<std::string, Json> by_run;
  for (const fs::path& folder : folders) {
    for (const fs::path& file : record_files(folder)) {
      for (auto& [record, place] : placed_records(file, notes)) {
        const std::string foreign = foreign_part(experiment, record);
        if (!foreign.empty()) throw InputError(std::string(place).append(": does not belong here: ").append(foreign));
        const auto [found, is_new] = by_run.try_emplace(run_key(record), record);
        if (is_new) continue;
        // A finished run takes precedence over a failed or absent one; two finished ones must agree.
        if (is_done(found->second) && is_done(record)) {
          if (outcome(found->second) != outcome(record)) {
            throw InputError(place + ": has another result for " + run_name(record) +
                             " than an earlier record: the records are of different programs or experiments");
          }
          notes.push_back(place + ": " + run_name(record) + " is recorded twice, the first record counts");
        } else if (!is_done(found->second)) {
          found->second = std::move(record);
        }
      }
    }
  }
  std::vector<Json> records;
  records.reserve(by_run.size());
  for (auto& [key, record] : by_run) records.push_back(std::move(record));
  return records;
}

}  // namespace deliso
