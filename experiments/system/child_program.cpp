#include "experiments/system/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "delaunay/base/check.h"
#include "delaunay/base/stopwatch.h"

namespace deliso {
namespace {

// In the child, in a group of its own, so that what it starts can be ended with it.
[[noreturn]] void become(const std::filesystem::path& program, std::vector<std::string> arguments, int out) {
  setpgid(0, 0);
  const std::string name = program.string();
  arguments.insert(arguments.begin(), name);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  dup2(out, STDOUT_FILENO);
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
  execv(name.c_str(), pointers.data());
  _exit(127);
}

// Reads until the other end is closed or the time is over; tells whether it was closed.
bool read_all(int in, double seconds, std::string& text) {
  const Stopwatch watch;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const double left = seconds - watch.seconds();
    if (left <= 0) return false;
    pollfd waiting{in, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(left * 1000) + 1) <= 0) continue;
    const ssize_t count = read(in, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) return true;
  }
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::vector<std::string_view>& names) {
  const char* const folders = std::getenv("PATH");
  std::istringstream list(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(list, folder, ':');) {
    for (const std::string_view name : names) {
      const std::filesystem::path path = std::filesystem::path(folder) / name;
      if (access(path.c_str(), X_OK) == 0) return path;
    }
  }
  return std::nullopt;
}

ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw InputError(program.string() + " cannot be started: " + std::strerror(errno));
  }
  const pid_t child = fork();
  if (child == 0) become(program, arguments, ends[1]);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw InputError(program.string() + " cannot be started: " + std::strerror(errno));
  }
  ChildResult result;
  result.is_timed_out = !read_all(ends[0], seconds, result.out);
  close(ends[0]);
  if (result.is_timed_out) kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace deliso
