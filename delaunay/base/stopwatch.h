// Wall-clock time on the steady clock, and the peak memory of this process.
#pragma once

#include <chrono>
#include <cstdint>

namespace deliso {

class Stopwatch {
 public:
  // Seconds since construction or the last restart.
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace deliso
