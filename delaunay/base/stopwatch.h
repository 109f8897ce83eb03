// Wall-clock time on the steady clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace deliso {

class Stopwatch {
 public:
  // Seconds since construction.
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace deliso
