#include "experiments/program_info.h"

#include <sys/resource.h>

#include <fstream>

#include "deliso_commit.h"  // written by the build: kCommit

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

ProgramInfo program_info() { return {DELISO_VERSION, kCommit, DELISO_COMPILER, DELISO_FLAGS, cpu_name()}; }

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace deliso
