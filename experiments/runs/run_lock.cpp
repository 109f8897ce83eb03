#include "experiments/runs/run_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "delaunay/base/check.h"

namespace deliso {

RunLock::RunLock(const std::filesystem::path& folder, const Shard& shard, std::size_t runs, Part part) {
  // If the folder is not writable this fails silently; it is reported when the records are opened.
  file_ = open((folder / ".run.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return;
  try {
    if (shard.count == 1) {
      lock_bytes(folder, 0, runs);
    } else {
      for (std::size_t run = 0; run < runs; ++run) {
        const bool is_own = run % shard.count == shard.index - 1;
        if (is_own == (part == Part::kOwn)) lock_bytes(folder, run, 1);
      }
    }
  } catch (...) {
    close(file_);
    throw;
  }
}

RunLock::~RunLock() {
  if (file_ >= 0) close(file_);  // releases the lock
}

void RunLock::lock_bytes(const std::filesystem::path& folder, std::size_t first, std::size_t count) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(first);
  range.l_len = static_cast<off_t>(count);
  // The lock belongs to the open file, not to the process: reading records elsewhere in the program cannot release it.
  if (fcntl(file_, F_OFD_SETLK, &range) == 0 || (errno != EAGAIN && errno != EACCES)) return;
  throw InputError("--out: another process is making these runs in " + folder.string() +
                   " at this moment; wait for its end or name another folder");
}

}  // namespace deliso
