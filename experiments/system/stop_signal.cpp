#include "experiments/system/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

#include "experiments/system/exit_code.h"

namespace deliso {
namespace {

// The only globals of the program: a signal handler can access nothing else.
std::atomic<bool> stop_requested{false};
std::atomic<bool> stop_held{false};
std::atomic<std::int64_t> first_stop{0};  // when the first signal came, in nanoseconds; 0: none yet
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

constexpr const char* kStoppedText = "stopped by a signal, no file was written";
constexpr std::string_view kStoppedLine = "deliso: stopped by a signal, no file was written\n";

std::int64_t steady_nanoseconds() {
  constexpr std::int64_t kPerSecond = 1'000'000'000;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return kPerSecond * now.tv_sec + now.tv_nsec;
}

// The first signal asks for an end. Whoever sends one often sends two at once (`timeout` one to the program and one to
// its group), so what follows within a second is the same request; later ones have their default effect.
extern "C" void request_stop(int signal) {
  constexpr std::int64_t kSameRequest = 1'000'000'000;
  stop_requested.store(true);
  const std::int64_t now = steady_nanoseconds();
  std::int64_t first = 0;
  if (first_stop.compare_exchange_strong(first, now) || now - first < kSameRequest) return;
  std::signal(signal, SIG_DFL);
  raise(signal);
}

// Calls only what is safe in a signal handler.
extern "C" void stop_now(int /*signal*/) {
  stop_requested.store(true);
  if (stop_held.load()) return;
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kStoppedLine.data(), kStoppedLine.size());
  _exit(static_cast<int>(ExitCode::kStopped));
}

void handle_stop_signals(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

const std::atomic<bool>& catch_stop_signals() {
  handle_stop_signals(request_stop, static_cast<int>(SA_RESTART));
  return stop_requested;
}

void stop_at_signals() {
  handle_stop_signals(stop_now, static_cast<int>(SA_RESTART));
  // Exceeding the file size limit is then a failed write like any other: it gives a message and leaves nothing behind.
  std::signal(SIGXFSZ, SIG_IGN);
}

const char* Stopped::what() const noexcept { return kStoppedText; }

StopHold::StopHold() { stop_held.store(true); }

StopHold::~StopHold() {
  if (!finished_) stop_held.store(false);
}

void StopHold::check() const {
  if (stop_requested.load()) throw Stopped();
}

}  // namespace deliso
