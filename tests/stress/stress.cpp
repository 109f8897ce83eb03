// The stress test: for each kind of field many seeded random volumes, each meshed, written, read back and verified.
// Prints a table, and leaves the volume of every run that is not proven with the commands that show it.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <string_view>

#include "delaunay/base/stopwatch.h"
#include "tests/stress/stress_kinds.h"
#include "tests/stress/stress_run.h"
#include "volume/io/volume_file.h"

namespace deliso::testing {
namespace {

struct StressOptions {
  std::int64_t runs = 100;  // of each kind; fewer of large ones
  std::uint64_t first_seed = 1;
  std::string kinds;  // names with commas between them; empty: all
  std::filesystem::path out = "stress_out";
  double kind_seconds = 600;  // no further run of a kind after these
  double run_seconds = 60;    // a run's limit
};

bool is_wanted(std::string_view kind, const std::string& kinds) {
  return kinds.empty() || ("," + kinds + ",").find("," + std::string(kind) + ",") != std::string::npos;
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kProven:
      return "proven";
    case Outcome::kTold:
      return "not proven, as told";
    case Outcome::kContradicted:
      return "CONTRADICTED: mesh says proven, verify does not";
    case Outcome::kAlarm:
      return "ALARM: mesh does not say proven, verify does";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kStopped:
      return "stopped by its limit of time";
    default:
      return "BROKEN";
  }
}

// Leaves what shows a run again.
void keep_case(const StressKind& kind, std::uint64_t seed, const StressCase& stress_case, const StressResult& result,
               const std::filesystem::path& out, std::ostream& log) {
  const std::filesystem::path volume = out / (std::string(kind.name) + "_" + std::to_string(seed) + ".nrrd");
  write_volume(stress_case.grid, volume);
  log << kind.name << " " << seed << ": " << name_of(result.outcome) << " (" << result.vertices << " vertices, "
      << result.seconds << " s)\n  " << commands_of(stress_case, volume) << '\n';
  for (const std::string& reason : result.reasons) log << "  " << reason << '\n';
  log.flush();
}

StressSums run_kind(const StressKind& kind, const StressOptions& options, std::ostream& log) {
  StressSums sums;
  const Stopwatch watch;
  const std::int64_t runs = std::max<std::int64_t>(1, options.runs / kind.share);
  for (std::int64_t i = 0; i < runs && watch.seconds() < options.kind_seconds; ++i) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(i);
    const StressCase stress_case = make_stress_case(kind, seed);
    const StressResult result = run_stress_case(stress_case, options.run_seconds, options.out);
    sums.add(result);
    const bool is_expected = result.outcome == Outcome::kProven || result.outcome == Outcome::kRefused;
    if (!is_expected) keep_case(kind, seed, stress_case, result, options.out, log);
  }
  return sums;
}

void print_row(const StressKind& kind, const StressSums& sums, double ordinary) {
  const double per_vertex = sums.seconds / static_cast<double>(std::max<std::int64_t>(1, sums.vertices));
  std::cout << "| " << kind.name << " | " << sums.runs << " | " << sums.proven << " | " << sums.told << " | "
            << sums.contradicted << " | " << sums.alarms << " | " << sums.refused << " | " << sums.stopped << " | "
            << sums.broken << " | " << std::setprecision(3)
            << sums.seconds / double(std::max<std::int64_t>(1, sums.runs)) << " | " << sums.slowest << " | "
            << (ordinary > 0 ? per_vertex / ordinary : 1) << " |" << std::endl;
}

bool run_all(const StressOptions& options) {
  std::filesystem::create_directories(options.out);
  std::ofstream log(options.out / "cases.txt", std::ios::app);
  std::cout << "| kind | runs | proven | told | contradicted | alarms | refused | stopped | broken | seconds | slowest "
               "| per vertex |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  double ordinary = 0;  // seconds per vertex
  bool is_right = true;
  for (const StressKind& kind : stress_kinds()) {
    const bool is_first = &kind == &stress_kinds().front();
    if (!is_first && !is_wanted(kind.name, options.kinds)) continue;
    const StressSums sums = run_kind(kind, options, log);
    if (is_first) ordinary = sums.seconds / double(std::max<std::int64_t>(1, sums.vertices));
    print_row(kind, sums, ordinary);
    is_right = is_right && sums.contradicted == 0 && sums.alarms == 0 && sums.broken == 0 && sums.stopped == 0;
  }
  return is_right;
}

bool take(const std::string& key, const std::string& value, StressOptions& options) {
  if (key == "--runs") options.runs = std::stoll(value);
  if (key == "--seed") options.first_seed = std::stoull(value);
  if (key == "--kinds") options.kinds = value;
  if (key == "--out") options.out = value;
  if (key == "--kind-seconds") options.kind_seconds = std::stod(value);
  if (key == "--run-seconds") options.run_seconds = std::stod(value);
  return key == "--runs" || key == "--seed" || key == "--kinds" || key == "--out" || key == "--kind-seconds" ||
         key == "--run-seconds";
}

}  // namespace
}  // namespace deliso::testing

int main(int argc, char** argv) {
  deliso::testing::StressOptions options;
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc || !deliso::testing::take(argv[i], argv[i + 1], options)) {
      std::cerr << "usage: stress [--runs N] [--seed N] [--kinds NAME,NAME] [--out DIR] [--kind-seconds S] "
                   "[--run-seconds S]\n";
      return 2;
    }
  }
  return deliso::testing::run_all(options) ? 0 : 1;
}
