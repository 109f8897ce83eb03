#include "volume/io/nrrd/nrrd_data_files.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace deliso {

namespace {

constexpr std::uint64_t kMostFiles = 1 << 20;

// The one conversion of a row of file names: % [0] [width] d, i or u.
struct NumberPattern {
  std::string before, after;
  std::size_t width = 0;
  bool has_zeros = false;

  [[nodiscard]] std::string name(std::int64_t number) const {
    std::string digits = std::to_string(number < 0 ? -number : number);
    const std::size_t sign = number < 0 ? 1 : 0;
    const std::size_t fill = width > digits.size() + sign ? width - digits.size() - sign : 0;
    if (has_zeros) digits.insert(0, fill, '0');
    if (number < 0) digits.insert(0, "-");
    if (!has_zeros) digits.insert(0, fill, ' ');
    return before + digits + after;
  }
};

std::optional<NumberPattern> parse_pattern(const std::string& text) {
  NumberPattern pattern;
  const std::size_t percent = text.find('%');
  if (percent == std::string::npos) return std::nullopt;
  pattern.before = text.substr(0, percent);
  std::size_t at = percent + 1;
  pattern.has_zeros = at < text.size() && text[at] == '0';
  for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
    pattern.width = 10 * pattern.width + static_cast<std::size_t>(text[at] - '0');
    constexpr std::size_t kWidest = 100;
    if (pattern.width > kWidest) return std::nullopt;
  }
  if (at == text.size() || (text[at] != 'd' && text[at] != 'i' && text[at] != 'u')) return std::nullopt;
  pattern.after = text.substr(at + 1);
  if (pattern.after.find('%') != std::string::npos) return std::nullopt;
  return pattern;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + ' ') {
    if (c != ' ' && c != '\t') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

// Name FIRST LAST STEP [SUBDIMENSION].
std::vector<std::filesystem::path> numbered_files(const NrrdFields& fields, const NrrdField& field,
                                                  const std::filesystem::path& folder, std::uint64_t most) {
  const char* const expected = "a file name, or like \"name%03d.raw 1 50 1\"";
  const std::vector<std::string> words = split(field.value);
  const std::optional<NumberPattern> pattern = parse_pattern(words.empty() ? "" : words[0]);
  if (!pattern || (words.size() != 4 && words.size() != 5)) fields.fail_value(field, expected);
  const std::int64_t first = fields.integer(field, words[1]), last = fields.integer(field, words[2]);
  const std::int64_t step = fields.integer(field, words[3]);
  constexpr std::int64_t kLargest = std::int64_t{1} << 40;
  const auto is_large = [](std::int64_t v) { return v > kLargest || v < -kLargest; };
  if (step == 0 || is_large(first) || is_large(last) || is_large(step) || (last - first) / step < 0)
    fields.fail_value(field, expected);
  const auto count = static_cast<std::uint64_t>((last - first) / step) + 1;
  if (count > most) fields.fail_value(field, "no more files than samples");
  std::vector<std::filesystem::path> files;
  for (std::uint64_t n = 0; n < count; ++n)
    files.push_back(folder / pattern->name(first + static_cast<std::int64_t>(n) * step));
  return files;
}

}  // namespace

std::vector<std::filesystem::path> nrrd_data_files(const NrrdFields& fields, const NrrdField& field,
                                                   const std::filesystem::path& folder, std::uint64_t most) {
  if (field.value.empty()) fields.fail_value(field, "a file name");
  most = std::min(most, kMostFiles);
  if (is_file_list(field)) {
    if (fields.list().empty()) fields.fail_value(field, "a file name in each of the lines that follow");
    if (fields.list().size() > most) fields.fail_value(field, "no more files than samples");
    std::vector<std::filesystem::path> files;
    for (const NrrdField& line : fields.list()) files.push_back(folder / line.value);
    return files;
  }
  // A single file may have a percent sign in its name.
  if (field.value.find('%') != std::string::npos && split(field.value).size() > 1)
    return numbered_files(fields, field, folder, most);
  return {folder / field.value};
}

}  // namespace deliso
