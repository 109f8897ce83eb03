// Prevents two processes from making the same runs in one folder at the same time.
#pragma once

#include <cstddef>
#include <filesystem>

#include "experiments/runs/experiment.h"

namespace deliso {

// Holds a lock on the runs of a shard for its lifetime. It is a kernel lock on the bytes of an empty file in the
// folder, one byte for each run. So it vanishes when the process ends, in whatever way; two shards conflict only if
// they share a run, whatever their counts; and the remaining file means nothing. If the file system cannot lock, no
// lock is taken.
class RunLock {
 public:
  enum class Part { kOwn, kOthers };  // the runs of the shard, or all others
  // `runs`: how many the whole experiment has. Throws InputError when another process holds one of them.
  RunLock(const std::filesystem::path& folder, const Shard& shard, std::size_t runs, Part part = Part::kOwn);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  void lock_bytes(const std::filesystem::path& folder, std::size_t first, std::size_t count);

  int file_ = -1;
};

}  // namespace deliso
