// The fields of a binary header, at fixed places, in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "volume/io/base/byte_stream.h"
#include "volume/sample_type.h"

namespace deliso {

class HeaderBytes {
 public:
  explicit HeaderBytes(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  void set_endian(Endian endian) { endian_ = endian; }
  [[nodiscard]] Endian endian() const { return endian_; }

  // Precondition: it lies within the header.
  template <class Number>
  [[nodiscard]] Number at(std::size_t place) const {
    DELISO_CHECK(place + sizeof(Number) <= bytes_.size(), "fields lie within the header");
    std::array<std::byte, sizeof(Number)> field;
    std::memcpy(field.data(), bytes_.data() + place, sizeof(Number));
    if (endian_ != kHostEndian) std::reverse(field.begin(), field.end());
    return std::bit_cast<Number>(field);
  }
  [[nodiscard]] std::string text(std::size_t place, std::size_t count) const {
    DELISO_CHECK(place + count <= bytes_.size(), "fields lie within the header");
    return {reinterpret_cast<const char*>(bytes_.data()) + place, count};
  }

 private:
  std::vector<std::byte> bytes_;
  Endian endian_ = kHostEndian;
};

// "DimSize along x": of a header that has a row of numbers under one name.
inline std::string along_axis(const std::string& name, std::size_t axis) {
  return name + " along " + (axis < 3 ? std::string(1, "xyz"[axis]) : "the axis " + std::to_string(axis + 1));
}

// A dimension as a header has it, as one of Dims; throws InputError unless it is from 1 to 2^31 - 3. `name`: what the
// header calls it.
template <class Integer>
std::int32_t dimension_of(const ByteStream& file, const std::string& name, Integer size) {
  constexpr auto kMost = std::numeric_limits<std::int32_t>::max() - 2;
  if (std::cmp_less(size, 1) || std::cmp_greater(size, kMost))
    file.fail(name + " is " + std::to_string(size) + ", expected 2 to " + std::to_string(kMost));
  return static_cast<std::int32_t>(size);
}

}  // namespace deliso
