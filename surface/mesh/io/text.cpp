#include "surface/mesh/io/text.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool parse_whole(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

bool parse_number(std::string_view word, double& value) { return parse_whole(word, value); }
bool parse_integer(std::string_view word, std::int64_t& value) { return parse_whole(word, value); }

void TextScanner::skip_blanks() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  if (comment_ == 0 || position_ == text_.size() || text_[position_] != comment_) return;
  while (position_ < text_.size() && text_[position_] != '\n') ++position_;
}

std::string_view TextScanner::word_on_line() {
  skip_blanks();
  const std::size_t begin = position_;
  while (position_ < text_.size() && text_[position_] != '\n' && !is_blank(text_[position_])) ++position_;
  return text_.substr(begin, position_ - begin);
}

std::string_view TextScanner::word() {
  while (true) {
    const std::string_view found = word_on_line();
    if (!found.empty() || !next_line()) return found;
  }
}

bool TextScanner::next_line() {
  while (position_ < text_.size() && text_[position_] != '\n') ++position_;
  if (position_ == text_.size()) return false;
  ++position_;
  ++line_;
  return true;
}

double TextScanner::number(const char* what) {
  const std::string_view found = word();
  double value = 0;
  if (!parse_number(found, value) || !std::isfinite(value)) fail(std::string(what) + " (a finite number)", found);
  return value;
}

std::int64_t TextScanner::integer(const char* what, std::int64_t low) {
  const std::string_view found = word();
  std::int64_t value = 0;
  if (!parse_integer(found, value) || value < low) fail(what, found);
  return value;
}

Vec3 TextScanner::point() {
  const double x = number("an x coordinate");
  const double y = number("a y coordinate");
  const double z = number("a z coordinate");
  return {x, y, z};
}

void TextScanner::fail(const std::string& what, std::string_view found) const {
  constexpr std::size_t kLongest = 40;  // of a culprit quoted in a message
  std::string message = file_ + ", line " + std::to_string(line_) + ": expected " + what + ", found ";
  if (found.empty()) {
    message += "nothing";
  } else {
    message.append(1, '\'').append(found.substr(0, kLongest)).append(1, '\'');
  }
  throw InputError(message);
}

void append_point(std::string& text, const Vec3& p) {
  append_number(text, p.x);
  text += ' ';
  append_number(text, p.y);
  text += ' ';
  append_number(text, p.z);
  text += '\n';
}

bool same_letters(std::string_view word, std::string_view capitals) {
  const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; };
  return std::equal(word.begin(), word.end(), capitals.begin(), capitals.end(),
                    [&](char a, char b) { return upper(a) == b; });
}

bool may_be_ascii_stl(std::string_view text) {
  constexpr std::string_view kFirst = "SOLID", kFacet = "FACET";
  if (!same_letters(text.substr(0, kFirst.size()), kFirst)) return false;
  for (std::size_t at = text.find_first_of("Ff"); at != std::string_view::npos; at = text.find_first_of("Ff", at + 1)) {
    if (same_letters(text.substr(at, kFacet.size()), kFacet)) return true;
  }
  return false;
}

std::string percent_decoded(std::string_view text) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_code = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out += is_code ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    if (is_code) i += 2;
  }
  return out;
}

}  // namespace deliso
