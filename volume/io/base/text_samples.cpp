#include "volume/io/base/text_samples.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace deliso {

namespace {

template <class Number>
bool parse_whole(std::string_view word, Number& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if constexpr (std::is_floating_point_v<Number>) {
    // A number too small for the type is 0, as everywhere.
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
      double wide = 0;
      const auto wider = std::from_chars(word.data(), word.data() + word.size(), wide);
      if (wider.ec != std::errc() || wide > 1 || wide < -1) return false;
      value = static_cast<Number>(wide);
      return true;
    }
  }
  return error == std::errc() && end == word.data() + word.size();
}

// The words of a stream, read in chunks.
class Words {
 public:
  explicit Words(ByteStream& stream) : stream_(stream) {}

  // The next word; empty at the end.
  std::string_view next() {
    word_.clear();
    while (fill()) {
      const char c = buffer_[position_++];
      const bool is_blank = c == ' ' || (c >= '\t' && c <= '\r') || c == ',';
      if (!is_blank) word_ += c;
      if (is_blank && !word_.empty()) break;
      constexpr std::size_t kLongestWord = 400;
      if (word_.size() > kLongestWord) break;
    }
    return word_;
  }

 private:
  bool fill() {
    if (position_ < end_) return true;
    position_ = 0;
    end_ = stream_.read(std::as_writable_bytes(std::span(buffer_)));
    return end_ > 0;
  }

  ByteStream& stream_;
  std::array<char, 1 << 14> buffer_{};
  std::size_t position_ = 0, end_ = 0;
  std::string word_;
};

template <class Number>
std::string numbers_as_bytes(ByteStream& stream, StoredType type, std::uint64_t count, bool may_go_on) {
  // A number takes at least a digit and a blank.
  if (count > stream.bound() / 2 + 1)
    stream.fail("the dimensions need " + std::to_string(count) + " numbers, but the text has only " +
                std::to_string(stream.bound()) + " characters");
  Words words(stream);
  std::string out;
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::string_view word = words.next();
    Number value{};
    if (word.empty()) {
      stream.fail("the text ends after " + std::to_string(n) + " numbers, but the dimensions need " +
                  std::to_string(count));
    }
    if (!parse_whole(word, value))
      stream.fail("number " + std::to_string(n) + " is " + in_quotes(word) + ", expected one of the type " +
                  short_type_name(type));
    const auto bytes = std::as_bytes(std::span(&value, 1));
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  if (!may_go_on && !words.next().empty())
    stream.fail("the text goes on after the " + std::to_string(count) + " numbers that the dimensions need");
  return out;
}

}  // namespace

bool parse_word(std::string_view word, double& value) { return parse_whole(word, value); }
bool parse_word(std::string_view word, std::int64_t& value) { return parse_whole(word, value); }

std::string bytes_of_numbers(ByteStream& stream, StoredType type, std::uint64_t count, bool may_go_on) {
  const auto as = [&]<class Number>(Number /*type*/) {
    return numbers_as_bytes<Number>(stream, type, count, may_go_on);
  };
  switch (type) {
    case StoredType::kU8:
    case StoredType::kBool:
      return as(std::uint8_t{});
    case StoredType::kI8:
      return as(std::int8_t{});
    case StoredType::kU16:
      return as(std::uint16_t{});
    case StoredType::kI16:
      return as(std::int16_t{});
    case StoredType::kI32:
      return as(std::int32_t{});
    case StoredType::kU32:
      return as(std::uint32_t{});
    case StoredType::kU64:
      return as(std::uint64_t{});
    case StoredType::kI64:
      return as(std::int64_t{});
    case StoredType::kF32:
      return as(float{});
    case StoredType::kF64:
      return as(double{});
    case StoredType::kF16:
      break;
  }
  stream.fail("samples of the type " + short_type_name(type) + " are written as text, expected another type");
}

}  // namespace deliso
