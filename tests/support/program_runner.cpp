#include "tests/support/program_runner.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

#include "delaunay/base/stopwatch.h"

namespace deliso::testing {
namespace {

// In the child: the streams go to files (a pipe could fill up while nobody reads), then the program takes over.
[[noreturn]] void become_program(const std::string& program, std::vector<std::string> arguments, const std::string& out,
                                 const std::string& err) {
  arguments.insert(arguments.begin(), program);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open(out.c_str(), kFlags, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), kFlags, 0600), STDERR_FILENO);
  execv(program.c_str(), pointers.data());
  _exit(127);
}

// Until a file or folder holds something, or for a minute: whoever waits for more will see that it does not.
void wait_for(const std::filesystem::path& file) {
  const Stopwatch stopwatch;
  std::error_code ignored;
  while (stopwatch.seconds() < 60 &&
         !(std::filesystem::exists(file, ignored) && !std::filesystem::is_empty(file, ignored))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

ProgramResult run_deliso(const std::vector<std::string>& arguments, std::optional<SignalAfter> signal) {
  return run_program_at(DELISO_PROGRAM, arguments, std::move(signal));
}

ProgramResult run_program_at(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             std::optional<SignalAfter> signal) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  const Stopwatch stopwatch;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_program(program.string(), arguments, out, err);
  if (signal) {
    if (!signal->file.empty()) wait_for(signal->file);
    std::this_thread::sleep_for(signal->delay);
    kill(child, signal->signal);  // a program that has ended is not waited for yet, so its id is still its own
  }
  int status = 0;
  waitpid(child, &status, 0);
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exit_code, read_file(out), read_file(err), stopwatch.seconds()};
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream << bytes;
  if (!stream) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace deliso::testing
