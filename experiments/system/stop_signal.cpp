#include "experiments/system/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "experiments/system/exit_code.h"

namespace deliso {
namespace {

// The only globals of the program: a signal handler can access nothing else.
std::atomic<bool> stop_requested{false};
std::atomic<bool> stop_held{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

constexpr const char* kStoppedText = "stopped by a signal, no file was written";
constexpr std::string_view kStoppedLine = "deliso: stopped by a signal, no file was written\n";

extern "C" void request_stop(int /*signal*/) { stop_requested.store(true); }

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
  // The second signal has its default effect.
  handle_stop_signals(request_stop, static_cast<int>(SA_RESETHAND | SA_RESTART));
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
