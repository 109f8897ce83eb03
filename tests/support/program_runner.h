// Runs the program `deliso` as a user would: as a process, judged by its exit code, its output and the files it leaves.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace deliso::testing {

struct ProgramResult {
  int exit_code = 0;  // 128 + signal when a signal ended it
  std::string out;    // standard output
  std::string err;    // standard error
  double seconds = 0;
};

// A signal to send while the program runs.
struct SignalAfter {
  int signal = SIGINT;
  std::chrono::milliseconds delay{0};
  std::filesystem::path file = {};  // when given, the delay begins once this file or folder holds something
};

// Runs the program of this build to its end.
ProgramResult run_deliso(const std::vector<std::string>& arguments, std::optional<SignalAfter> signal = std::nullopt);

// The same of another program.
ProgramResult run_program_at(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             std::optional<SignalAfter> signal = std::nullopt);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace deliso::testing
