// The two kinds of failure that travel as exceptions. (An expected outcome is a value, never an exception.)
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace deliso {

// Something the user gave is wrong: a file, a key, a value. The message is one sentence that names it, the value found
// and what was expected. The program answers with exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(without_ends(message)) {}

 private:
  // A name quoted in the message may contain a zero byte, which would end the text of what().
  static std::string without_ends(std::string message) {
    std::replace(message.begin(), message.end(), '\0', ' ');
    return message;
  }
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
