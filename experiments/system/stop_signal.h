// SIGINT and SIGTERM: a request to finish early, or the end of the program.
#pragma once

#include <atomic>
#include <exception>

namespace deliso {

// For a command with partial results: from now on the first SIGINT or SIGTERM sets the flag that is returned; one that
// comes a second later, or more, ends the program at once.
const std::atomic<bool>& catch_stop_signals();

// For every other command: from now on SIGINT or SIGTERM ends the program at once, with one line on stderr and
// ExitCode::kStopped, unless a StopHold exists.
void stop_at_signals();

// Thrown when a signal came while a StopHold existed: the program must end with ExitCode::kStopped.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override;
};

// Delays a signal while a file is half written, so that the file can be removed first. At most one may exist at a time.
// Does not affect a flag of catch_stop_signals.
class StopHold {
 public:
  StopHold();
  ~StopHold();
  StopHold(const StopHold&) = delete;
  StopHold& operator=(const StopHold&) = delete;

  // Throws Stopped when a signal is waiting.
  void check() const;
  // The result is in place: from now on a waiting signal is ignored, so that the rest is done.
  void finish() { finished_ = true; }

 private:
  bool finished_ = false;
};

}  // namespace deliso
