// Reading and writing the numbers of binary formats, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "delaunay/base/check.h"

namespace deliso {

template <class Number>
Number byte_swapped(Number value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

template <class Number>
void append_little_endian(std::string& bytes, Number value) {
  if constexpr (std::endian::native == std::endian::big) value = byte_swapped(value);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Number>
void append_big_endian(std::string& bytes, Number value) {
  if constexpr (std::endian::native == std::endian::little) value = byte_swapped(value);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Walks through binary data. `what` names the thing that is missing when the data end early.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string file, std::endian order, std::size_t position = 0)
      : bytes_(bytes), file_(std::move(file)), swap_(order != std::endian::native), position_(position) {}

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - position_; }

  template <class Number>
  Number read(const char* what) {
    if (remaining() < sizeof(Number)) fail_truncated(what);
    Number value;
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return swap_ ? byte_swapped(value) : value;
  }
  void skip(std::size_t count, const char* what) {
    if (remaining() < count) fail_truncated(what);
    position_ += count;
  }
  // Throws InputError: "FILE, before byte N: expected WHAT".
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_ + ", before byte " + std::to_string(position_) + ": expected " + what);
  }

 private:
  [[noreturn]] void fail_truncated(const char* what) const {
    throw InputError(file_ + ", byte " + std::to_string(position_) + ": expected " + what +
                     ", but the file ends at byte " + std::to_string(bytes_.size()));
  }

  std::string_view bytes_;
  std::string file_;
  bool swap_;
  std::size_t position_;
};

}  // namespace deliso
