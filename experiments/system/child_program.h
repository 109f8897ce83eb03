// Another program, run to its end with what it writes.
#pragma once

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
  std::string out;            // its standard output
};

// Runs a program with its arguments; its standard error is dropped. Throws InputError when it cannot be started.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds);

}  // namespace deliso
