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

// The most memory this process has held so far, in bytes, but for some pages that the system has not added up yet.
std::int64_t peak_memory_bytes();

// Lets the peak begin anew from what is in use now, freed memory given back first. Does nothing where the system
// cannot.
void reset_peak_memory();

}  // namespace deliso
