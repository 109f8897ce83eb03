// Numbers in messages and files, with as few digits as read back as the same number.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace deliso {

// The shortest text that reads back as the same double.
inline std::string shortest_text(double value) {
  std::array<char, 32> buffer{};  // holds any double
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace deliso
