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

// For messages: nine significant digits where the number needs more and is of an ordinary size, else all.
inline std::string short_text(double value) {
  constexpr double kLargest = 1e9, kSmallest = 1e-4;
  const double size = value < 0 ? -value : value;
  if (!(size >= kSmallest && size < kLargest)) return shortest_text(value);
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9).ptr;
  const std::string rounded(buffer.data(), end), exact = shortest_text(value);
  return rounded.size() < exact.size() ? rounded : exact;
}

}  // namespace deliso
