// What this program is and where it runs: for `--version` and for every record.
#pragma once

#include <cstdint>
#include <string>

namespace deliso {

struct ProgramInfo {
  std::string version;
  std::string commit;    // of the checkout it was built from, "-dirty" when changed; "unknown" outside of one
  std::string compiler;  // name and version
  std::string flags;     // what the compiler was given
  std::string cpu;       // model name of this machine's processor; "unknown" where the system does not tell
};

ProgramInfo program_info();

// The peak memory of this process so far, in bytes, except for pages that the system has not counted yet.
std::int64_t peak_memory_bytes();

// Resets the peak to the memory in use now, after giving freed memory back. Does nothing where the system does not
// support it.
void reset_peak_memory();

}  // namespace deliso
