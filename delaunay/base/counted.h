// Counts of things, worded for messages.
#pragma once

#include <cstdint>
#include <string>

namespace deliso {

// "1 edge", "2 edges".
inline std::string counted(std::int64_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace deliso
