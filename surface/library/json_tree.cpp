#include "surface/library/json_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "delaunay/base/shortest_text.h"

namespace deliso {
namespace {

// The bytes of the UTF-8 character at the beginning of a text that begins with no ASCII character; 0: there is none.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first >= 0xF5 || first < 0xC2 ? 0 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u) return 0;
  }
  return length;
}

// Bytes that are no UTF-8, as names of files may have, become the replacement character.
std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const auto code = static_cast<unsigned char>(c);
    constexpr unsigned kFirstPrintable = 0x20, kFirstBeyondAscii = 0x80;
    if (c == '"' || c == '\\') out += '\\';
    if (code >= kFirstBeyondAscii) {
      const std::size_t length = character_length(text.substr(at));
      out += length > 0 ? text.substr(at, length) : "\\ufffd";
      at += length > 0 ? length - 1 : 0;
    } else if (code >= kFirstPrintable) {
      out += c;
    } else {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(code));
      out += escaped.data();
    }
  }
  return out + '"';
}

}  // namespace

// A number that reads back as a double, not as a whole number.
JsonTree::JsonTree(double value) {
  if (!std::isfinite(value)) return;
  text_ = shortest_text(value);
  if (text_.find_first_of(".e") == std::string::npos) text_ += ".0";
}

JsonTree::JsonTree(std::string_view value) : text_(json_string(value)) {}

JsonTree::JsonTree(std::initializer_list<Member> members) : kind_(Kind::kObject) {
  for (const auto& [key, value] : members) members_.emplace_back(key, value);
}

JsonTree& JsonTree::operator[](std::string_view key) {
  kind_ = Kind::kObject;
  const auto found = std::find_if(members_.begin(), members_.end(), [&](const auto& m) { return m.first == key; });
  return found != members_.end() ? found->second : members_.emplace_back(key, JsonTree()).second;
}

std::string JsonTree::text(int depth) const {
  if (kind_ == Kind::kPlain) return text_;
  const bool is_array = kind_ == Kind::kArray;
  if (members_.empty()) return is_array ? "[]" : "{}";
  const auto indentation = [](int of) { return std::string(2 * static_cast<std::size_t>(of), ' '); };
  std::string out(1, is_array ? '[' : '{');
  for (const auto& member : members_) {
    out += (&member == members_.data() ? "\n" : ",\n") + indentation(depth + 1);
    if (!is_array) out += json_string(member.first) + ": ";
    out += member.second.text(depth + 1);
  }
  return out + '\n' + indentation(depth) + (is_array ? ']' : '}');
}

}  // namespace deliso
