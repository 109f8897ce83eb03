// Another program, run to its end with what it writes and what it took.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

// The first of these that stands in a folder of PATH and can be executed.
std::optional<std::filesystem::path> find_program(const std::vector<std::string_view>& names);

struct ChildResult {
  int exit_code = 0;          // 128 and more: ended by a signal
  bool is_timed_out = false;  // it was ended after the time allowed, with all that it had started
  bool is_stopped = false;    // it was ended because the stop flag was set
  std::string out;            // its standard output
  std::string err;            // the end of its standard error
  double wall_seconds = 0;    // from its start to its end
  double user_seconds = 0;    // of processor time, with that of the processes that it waited for
  double system_seconds = 0;
  // At least that of this process when it was started (ProgramLauncher).
  std::int64_t peak_memory_bytes = 0;
};

// Runs a program with its arguments. Throws InputError when it cannot be started; a program that is not there ends with
// 127.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      const std::atomic<bool>* stop = nullptr);

}  // namespace deliso
