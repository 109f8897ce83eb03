// Keeps two processes from making the same runs in one folder at the same time.
#pragma once

#include <cstddef>
#include <filesystem>

#include "experiments/runs/experiment.h"

namespace deliso {

// Holds the runs of a shard for its lifetime. The lock is one of the kernel on the bytes of an empty file in the
// folder, a byte for each run: it vanishes with the process, however that ends, shards of any counts get into each
// other's way only where they share a run, and the file that stays tells nothing. A file system that cannot lock is
// taken without.
class RunLock {
 public:
  // `runs`: how many the whole experiment has. Throws InputError when another process holds one of the shard's.
  RunLock(const std::filesystem::path& folder, const Shard& shard, std::size_t runs);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  void lock_bytes(const std::filesystem::path& folder, std::size_t first, std::size_t count);

  int file_ = -1;
};

}  // namespace deliso
