// SIGINT and SIGTERM: a request to finish early, or the end of the program.
#pragma once

#include <atomic>
#include <exception>

namespace deliso {

// For a command with partial results: from now on the first SIGINT or SIGTERM sets the flag that is returned; a second
// one ends the program at once.
const std::atomic<bool>& catch_stop_signals();

// For every other command: from now on SIGINT or SIGTERM ends the program at once, with one line on stderr and
// ExitCode::kStopped, unless a StopHold lives.
void stop_at_signals();

// A signal came while a StopHold lived: the program is to end with ExitCode::kStopped.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override;
};

// Keeps a signal waiting while a file is half written, so that the file can be removed first. At most one lives at a
// time. Does nothing to a flag of catch_stop_signals.
class StopHold {
 public:
  StopHold();
  ~StopHold();
  StopHold(const StopHold&) = delete;
  StopHold& operator=(const StopHold&) = delete;

  // Throws Stopped when a signal waits.
  void check() const;
  // The result is in place: the little that is left is done whatever signal comes.
  void finish() { finished_ = true; }

 private:
  bool finished_ = false;
};

}  // namespace deliso
