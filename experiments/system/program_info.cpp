#include "experiments/system/program_info.h"

#include <sys/resource.h>

#include <fstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "deliso/version.h"  // written by the build, as is
#include "deliso_commit.h"   // kCommit

namespace deliso {
namespace {

std::string cpu_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

ProgramInfo program_info() { return {DELISO_VERSION_TEXT, kCommit, DELISO_COMPILER, DELISO_FLAGS, cpu_name()}; }

// getrusage is not used: its value includes the peak of the process that started this one.
std::int64_t peak_memory_bytes() {
  std::ifstream stream("/proc/self/status");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("VmHWM:")) return std::stoll(line.substr(6)) * 1024;  // "VmHWM:     1234 kB"
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void reset_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  constexpr int kPeakOfResidentSet = 5;  // see proc(5)
  std::ofstream("/proc/self/clear_refs") << kPeakOfResidentSet;
}

}  // namespace deliso
