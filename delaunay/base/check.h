// The two kinds of failure that travel as exceptions. (An expected outcome is a value, never an exception.)
#pragma once

#include <stdexcept>
#include <string>

namespace deliso {

// Something the user gave is wrong: a file, a key, a value. The message is one sentence that names it, the value found
// and what was expected. The program answers with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An invariant of ours is broken. The program answers with exit code 70.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] inline void fail_check(const char* file, int line, const char* condition, const char* why) {
  throw InternalError(std::string(file) + ":" + std::to_string(line) + ": " + why + " (" + condition + " is false)");
}

}  // namespace deliso

// A cheap check of an invariant; stays on in Release.
#define DELISO_CHECK(condition, why)                             \
  do {                                                           \
    if (!(condition)) [[unlikely]]                               \
      ::deliso::fail_check(__FILE__, __LINE__, #condition, why); \
  } while (false)
