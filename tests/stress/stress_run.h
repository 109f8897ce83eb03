// One run of the stress test: mesh, write, read back, verify; and the sums of many.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/stress/stress_kinds.h"

namespace deliso::testing {

enum class Outcome {
  kProven,        // the mesher says so, and so does the verification
  kTold,          // neither
  kContradicted,  // the mesher alone
  kAlarm,         // the verification alone
  kRefused,       // as bad input
  kStopped,       // by the limit of time
  kBroken         // an invariant
};

struct StressResult {
  Outcome outcome = Outcome::kBroken;
  std::int64_t vertices = 0;
  double seconds = 0;                // of the mesher, in which the processor ran
  std::vector<std::string> reasons;  // what either says
};

// `directory` is for the mesh's file.
StressResult run_stress_case(const StressCase& stress_case, double most_seconds,
                             const std::filesystem::path& directory);

struct StressSums {
  std::int64_t runs = 0, proven = 0, told = 0, contradicted = 0, alarms = 0, refused = 0, stopped = 0, broken = 0;
  std::int64_t vertices = 0;
  double seconds = 0, slowest = 0;
  void add(const StressResult& result);
};

// The volume of a case is the same for every run of the program.
StressCase make_stress_case(const StressKind& kind, std::uint64_t seed);

// The commands that do the same as a run, for a volume in a file.
std::string commands_of(const StressCase& stress_case, const std::filesystem::path& volume);

}  // namespace deliso::testing
