#include "experiments/system/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
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
[[noreturn]] void become(const std::filesystem::path& program, std::vector<std::string> arguments, int out, int err) {
  setpgid(0, 0);
  const std::string name = program.string();
  arguments.insert(arguments.begin(), name);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
  execv(name.c_str(), pointers.data());
  _exit(127);
}

// A pipe from the child. Closed at both ends when it goes.
class Pipe {
 public:
  explicit Pipe(const std::filesystem::path& program) {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw InputError(program.string() + " cannot be started: " + std::strerror(errno));
    }
  }
  ~Pipe() {
    close(ends_[0]);
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] int reader() const { return ends_[0]; }
  [[nodiscard]] int writer() const { return ends_[1]; }
  void close_writer() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }
  // Takes what is there; returns whether more may come.
  bool take(std::string& text) const {
    std::array<char, 1 << 16> buffer{};
    const ssize_t count = read(ends_[0], buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }

 private:
  std::array<int, 2> ends_{};
};

// Reads both until the other ends are closed, which is the end of the program, or until it has to be ended.
void read_all(const Pipe& out, const Pipe& err, double seconds, const std::atomic<bool>* stop, ChildResult& result) {
  constexpr int kLookForStop = 100;  // milliseconds
  constexpr std::size_t kMostOfError = 4096;
  const Stopwatch watch;
  std::array<pollfd, 2> waiting{pollfd{out.reader(), POLLIN, 0}, pollfd{err.reader(), POLLIN, 0}};
  while (waiting[0].fd >= 0 || waiting[1].fd >= 0) {
    const double left = seconds - watch.seconds();
    result.is_stopped = stop != nullptr && stop->load();
    result.is_timed_out = !result.is_stopped && left <= 0;
    if (result.is_stopped || result.is_timed_out) return;
    const int pause = left * 1000 < kLookForStop ? static_cast<int>(left * 1000) + 1 : kLookForStop;
    if (poll(waiting.data(), waiting.size(), pause) <= 0) continue;
    if (waiting[0].revents != 0 && !out.take(result.out)) waiting[0].fd = -1;
    if (waiting[1].revents != 0 && !err.take(result.err)) waiting[1].fd = -1;
    if (result.err.size() > 2 * kMostOfError) result.err.erase(0, result.err.size() - kMostOfError);
  }
}

double seconds_of(const timeval& time) {
  constexpr double kMicrosecond = 1e-6;
  return static_cast<double>(time.tv_sec) + kMicrosecond * static_cast<double>(time.tv_usec);
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

ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      const std::atomic<bool>* stop) {
  Pipe out(program);
  Pipe err(program);
  const Stopwatch watch;
  const pid_t child = fork();
  if (child == 0) become(program, arguments, out.writer(), err.writer());
  if (child < 0) throw InputError(program.string() + " cannot be started: " + std::strerror(errno));
  setpgid(child, child);  // here, too: it may have to be ended before it came to that
  out.close_writer();
  err.close_writer();
  ChildResult result;
  read_all(out, err, seconds, stop, result);
  if (result.is_timed_out || result.is_stopped) kill(-child, SIGKILL);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  result.wall_seconds = watch.seconds();
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.user_seconds = seconds_of(usage.ru_utime);
  result.system_seconds = seconds_of(usage.ru_stime);
  result.peak_memory_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
  return result;
}

}  // namespace deliso
