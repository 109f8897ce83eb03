// Files of records: one JSON object per line (JSON Lines). Each record is appended as a whole when its run ends.
//
// The folder of an experiment's results holds the experiment itself (experiment.json, with everything it refers to) and
// any number of files records*.jsonl, one for each shard.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// Appends records; append() returns after the record was flushed towards the disk.
class RecordFile {
 public:
  // A last line that a crash cut off is removed first. Throws InputError.
  explicit RecordFile(std::filesystem::path path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  // Throws InputError when the file system refuses.
  void append(const Json& record);

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

// "records.jsonl", or "records.2-of-5.jsonl".
std::string record_file_name(const Shard& shard);

// The record files of a results folder, sorted.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& folder);

// The records of a file. A last line without a line end was cut off: it is left out, and a sentence is added to
// `notes`. Throws InputError naming the line when another line is no record.
std::vector<Json> read_records(const std::filesystem::path& path, std::vector<std::string>& notes);

// The records of an experiment in some results folders, at most one for each run; a finished record takes precedence
// over others. Two records of a run with the same result are noted. Throws InputError naming file and line when their
// results differ, or when a record is not of the experiment.
std::vector<Json> merge_records(const Experiment& experiment, const std::vector<std::filesystem::path>& folders,
                                std::vector<std::string>& notes);

}  // namespace deliso
