#include "experiments/system/program_launcher.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

#include <nlohmann/json.hpp>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

using Json = nlohmann::ordered_json;

// The only global here: a signal handler can access nothing else. It is that of the launcher's process.
std::atomic<bool> end_program{false};

extern "C" void note_end(int /*signal*/) { end_program.store(true); }

// A line without its end; nothing when the other side is gone. `stop` is looked at while there is nothing to read.
std::optional<std::string> read_line(int in, const std::atomic<bool>* stop, pid_t told) {
  constexpr int kLookForStop = 100;  // milliseconds
  std::string line;
  bool has_told = false;
  for (;;) {
    if (stop != nullptr && stop->load() && !has_told) {
      kill(told, SIGTERM);
      has_told = true;
    }
    pollfd waiting{in, POLLIN, 0};
    if (poll(&waiting, 1, stop != nullptr ? kLookForStop : -1) <= 0) continue;
    std::array<char, 1 << 12> buffer{};
    const ssize_t count = read(in, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    line.append(buffer.data(), static_cast<std::size_t>(count));
    if (line.back() != '\n') continue;
    line.pop_back();
    return line;
  }
}

bool write_line(int out, const Json& json) {
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  std::size_t at = 0;
  while (at < line.size()) {
    const ssize_t count = write(out, line.data() + at, line.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += static_cast<std::size_t>(count);
  }
  return true;
}

Json result_json(const ChildResult& result) {
  return Json{{"exit_code", result.exit_code},           {"is_timed_out", result.is_timed_out},
              {"is_stopped", result.is_stopped},         {"err", result.err},
              {"wall_seconds", result.wall_seconds},     {"user_seconds", result.user_seconds},
              {"system_seconds", result.system_seconds}, {"peak_memory_bytes", result.peak_memory_bytes}};
}

ChildResult result_of(const Json& json) {
  ChildResult result;
  result.exit_code = json["exit_code"];
  result.is_timed_out = json["is_timed_out"];
  result.is_stopped = json["is_stopped"];
  result.err = json["err"];
  result.wall_seconds = json["wall_seconds"];
  result.user_seconds = json["user_seconds"];
  result.system_seconds = json["system_seconds"];
  result.peak_memory_bytes = json["peak_memory_bytes"];
  return result;
}

// So that a signal meets the handler of the launcher, never that of the process which it comes from.
void block_end(int how) {
  sigset_t end{};
  sigemptyset(&end);
  sigaddset(&end, SIGTERM);
  pthread_sigmask(how, &end, nullptr);
}

// Starts what it is told to, until the other side is gone.
[[noreturn]] void serve(int in, int out) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  struct sigaction action {};
  action.sa_handler = note_end;
  sigaction(SIGTERM, &action, nullptr);
  block_end(SIG_UNBLOCK);
  std::signal(SIGINT, SIG_IGN);  // whoever asks for programs decides what it means
  while (const std::optional<std::string> line = read_line(in, nullptr, 0)) {
    Json answer;
    try {
      const Json request = Json::parse(*line);
      answer = result_json(
          run_child(request["program"].get<std::string>(), request["arguments"], request["seconds"], &end_program));
    } catch (const std::exception& error) {
      answer = Json{{"error", error.what()}};
    }
    if (!write_line(out, answer)) break;
    end_program.store(false);
  }
  _exit(0);
}

}  // namespace

ProgramLauncher::ProgramLauncher() {
  std::array<int, 2> to{};
  std::array<int, 2> from{};
  const auto refuse = [] { throw InputError("cannot start a process: " + std::string(std::strerror(errno))); };
  if (pipe2(to.data(), O_CLOEXEC) != 0) refuse();
  if (pipe2(from.data(), O_CLOEXEC) != 0) refuse();
  block_end(SIG_BLOCK);
  process_ = fork();
  if (process_ != 0) block_end(SIG_UNBLOCK);
  if (process_ < 0) refuse();
  if (process_ == 0) {
    close(to[1]);
    close(from[0]);
    serve(to[0], from[1]);
  }
  close(to[0]);
  close(from[1]);
  to_ = to[1];
  from_ = from[0];
}

ProgramLauncher::~ProgramLauncher() {
  close(to_);
  close(from_);
  kill(process_, SIGTERM);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

ChildResult ProgramLauncher::run(const std::string& program, const std::vector<std::string>& arguments, double seconds,
                                 const std::atomic<bool>* stop) {
  const bool is_sent = write_line(to_, Json{{"program", program}, {"arguments", arguments}, {"seconds", seconds}});
  static const std::atomic<bool> kNever{false};
  const std::optional<std::string> line =
      is_sent ? read_line(from_, stop == nullptr ? &kNever : stop, process_) : std::nullopt;
  if (!line) throw InputError(program + " cannot be started: the process that starts programs is gone");
  const Json answer = Json::parse(*line);
  if (answer.contains("error")) throw InputError(answer["error"].get<std::string>());
  return result_of(answer);
}

}  // namespace deliso
