// Numbers in messages and files: as short as they can be without becoming another number.
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
