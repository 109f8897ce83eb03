// Reading and writing the words and numbers of text formats.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "delaunay/base/vec3.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// Walks through a text word by word and knows the line it is in. Words end at white space; `comment`, unless it is 0,
// starts a comment that runs to the end of the line.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string file, char comment = 0)
      : text_(text), file_(std::move(file)), comment_(comment) {}

  // The next word, on this line or a later one; empty at the end of the text.
  std::string_view word();
  // The next word of this line; empty when there is none left.
  std::string_view word_on_line();
  // The rest of this line is skipped. Returns false when there is no further line.
  bool next_line();
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t remaining() const { return text_.size() - position_; }
  [[nodiscard]] std::int64_t line() const { return line_; }

  // The next word as a finite number, a whole number of at least `low`, or three finite numbers. `what` names it in the
  // error, with its article.
  double number(const char* what);
  std::int64_t integer(const char* what, std::int64_t low = std::numeric_limits<std::int64_t>::min());
  Vec3 point();

  // Throws InputError: "FILE, line N: expected WHAT, found 'WORD'".
  [[noreturn]] void fail(const std::string& what, std::string_view found) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;
};

// Parses a whole word; false when it is not such a number. A leading plus sign is allowed.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

// Appends the shortest decimal that reads back as the same number.
template <class Number>
void append_number(std::string& text, Number value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}
// Appends "x y z" and a line feed.
void append_point(std::string& text, const Vec3& p);

// Whether a word is that in capitals, whatever its case.
bool same_letters(std::string_view word, std::string_view capitals);
// Whether an STL file may be text: "solid" comes first and "facet" later, in letters of any case.
bool may_be_ascii_stl(std::string_view text);
// A text in which %XX stands for the byte with this hexadecimal number.
std::string percent_decoded(std::string_view text);

// A label from a file. What is no label of ours becomes 0.
inline std::int32_t label_of_number(double value) {
  const bool fits = std::abs(value) < static_cast<double>(std::numeric_limits<std::int32_t>::max());
  return fits ? static_cast<std::int32_t>(value) : 0;
}

// Appends the fan of triangles of a polygon: corner 0 with every edge that does not touch it.
template <class Polygon>
void append_fan(TriangleMesh& mesh, const Polygon& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

}  // namespace deliso
