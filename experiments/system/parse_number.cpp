#include "experiments/system/parse_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <thread>

#include "delaunay/base/check.h"

namespace deliso {

double parse_number(const std::string& text, const std::string& option) { return parse_number(text, option, text); }

double parse_number(const std::string& text, const std::string& option, const std::string& typed,
                    const std::string& expected) {
  double value = 0;
  const bool plus = text.starts_with('+') && !text.starts_with("+-");
  const char* const begin = text.data() + (plus ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end || !std::isfinite(value)) {
    throw InputError(option + ": expected " + expected + ", found '" + typed + "'");
  }
  return value;
}

std::uint64_t parse_count(const std::string& text, const std::string& option, std::uint64_t low, std::uint64_t high) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < low || value > high) {
    throw InputError(option + ": expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                     ", found '" + text + "'");
  }
  return value;
}

std::int32_t parse_threads(const std::string& text) {
  constexpr std::uint64_t kMost = 1024;
  if (text == "auto") {
    return static_cast<std::int32_t>(std::clamp<std::uint64_t>(std::thread::hardware_concurrency(), 1, kMost));
  }
  return static_cast<std::int32_t>(parse_count(text, "--threads", 1, kMost));
}

std::string refuse_empty_name(const std::string& name) {
  return name.empty() ? "expected a name, found an empty one" : "";
}

std::string refuse_empty_value(const std::string& value) {
  return value.empty() ? "expected a value, found an empty one" : "";
}

}  // namespace deliso
