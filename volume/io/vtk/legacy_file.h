// The header and the arrays of a legacy VTK file, one after another.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "volume/io/base/volume.h"

namespace deliso {

struct LegacyArray {
  // Packed bits, texts and values of any type (a line each, also in binary files) are no samples, and only gone over.
  enum class Kind { kNumbers, kBits, kText, kLines };

  std::string name;
  StoredType type = StoredType::kU8;
  std::uint64_t components = 1;
  std::uint64_t tuples = 0;
  bool is_of_points = false;
  bool is_color = false;  // as text: bytes as fractions of 255
  Kind kind = Kind::kNumbers;
};

// Goes through a file once: its header, then one array after another. Field data of the whole (times, names, what VTK's
// writer puts after DATASET) and metadata are gone over.
class LegacyFile {
 public:
  LegacyFile(ByteStream& bytes, VolumeDescription& volume) : bytes_(bytes), volume_(volume) { read_header(); }

  [[nodiscard]] bool is_text() const { return is_text_; }
  // The next array; the stream is then at its first number. Nothing at the end.
  std::optional<LegacyArray> next();
  // Goes over the numbers of an array.
  void skip(const LegacyArray& array);

 private:
  [[noreturn]] void fail(const std::string& expected) const;
  std::vector<std::string> next_words();
  [[nodiscard]] std::uint64_t count(const std::string& word) const;
  [[nodiscard]] StoredType type(const std::string& word) const;
  [[nodiscard]] Vec3 three(const std::vector<std::string>& words) const;
  void read_header();
  void skip_metadata();
  std::optional<LegacyArray> next_of_field();
  std::optional<LegacyArray> attribute(const std::vector<std::string>& words, const std::string& keyword);
  void skip_packed_text(const LegacyArray& array, std::uint64_t texts);

  ByteStream& bytes_;
  VolumeDescription& volume_;
  std::string line_;
  bool is_text_ = false;
  bool is_of_points_ = false;
  std::uint64_t tuples_ = 0;
  std::uint64_t field_arrays_ = 0;  // that are still to come
};

}  // namespace deliso
