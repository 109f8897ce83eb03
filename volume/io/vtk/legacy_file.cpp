#include "volume/io/vtk/legacy_file.h"

#include <string_view>
#include <utility>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"
#include "volume/io/vtk/vtk_types.h"

namespace deliso {

namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : std::string(line) + ' ') {
    if (c != ' ' && c != '\t' && c != '\r') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

std::string in_capitals(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

}  // namespace

void LegacyFile::fail(const std::string& expected) const {
  bytes_.fail("the file has the line " + in_quotes(line_) + ", expected " + expected);
}

// The words of the next line that has any; none at the end.
std::vector<std::string> LegacyFile::next_words() {
  while (std::optional<std::string> line = bytes_.read_line()) {
    line_ = std::move(*line);
    std::vector<std::string> words = words_of(line_);
    if (!words.empty()) return words;
  }
  return {};
}

std::uint64_t LegacyFile::count(const std::string& word) const {
  std::int64_t value = 0;
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  if (!parse_word(word, value) || value < 0 || value > kMost) fail("whole numbers from 0 to 2^40");
  return static_cast<std::uint64_t>(value);
}

StoredType LegacyFile::type(const std::string& word) const {
  const std::optional<StoredType> found = legacy_vtk_type(word);
  if (!found) fail("a type of numbers: unsigned_char, short, float, ...");
  return *found;
}

Vec3 LegacyFile::three(const std::vector<std::string>& words) const {
  Vec3 out;
  if (words.size() != 4) fail("three numbers");
  for (std::size_t n = 0; n < 3; ++n) {
    if (!parse_word(words[n + 1], out[n]) || !std::isfinite(out[n])) fail("three finite numbers");
  }
  return out;
}

void LegacyFile::read_header() {
  line_ = bytes_.read_line().value_or("");
  if (!line_.starts_with("# vtk DataFile Version")) fail("\"# vtk DataFile Version 3.0\"");
  static_cast<void>(bytes_.read_line());  // the title
  const std::vector<std::string> encoding = next_words();
  is_text_ = encoding.size() == 1 && in_capitals(encoding[0]) == "ASCII";
  if (!is_text_ && (encoding.size() != 1 || in_capitals(encoding[0]) != "BINARY")) fail("ASCII or BINARY");
  const std::vector<std::string> dataset = next_words();
  if (dataset.size() != 2 || in_capitals(dataset[0]) != "DATASET") fail("DATASET STRUCTURED_POINTS");
  if (in_capitals(dataset[1]) != "STRUCTURED_POINTS") fail("STRUCTURED_POINTS: other grids are no volumes");
  Vec3 spacing{1, 1, 1}, origin;
  bool has_dims = false;
  for (std::vector<std::string> words = next_words(); !words.empty(); words = next_words()) {
    const std::string keyword = in_capitals(words[0]);
    if (keyword == "DIMENSIONS") {
      if (words.size() != 4) fail("three dimensions");
      for (std::size_t n = 0; n < 3; ++n)
        volume_.layout.dims.at(n) = dimension_of(bytes_, along_axis("DIMENSIONS", n), count(words[n + 1]));
      has_dims = true;
    } else if (keyword == "ORIGIN") {
      origin = three(words);
    } else if (keyword == "SPACING" || keyword == "ASPECT_RATIO") {
      spacing = three(words);
    } else if ((keyword == "POINT_DATA" || keyword == "CELL_DATA") && words.size() == 2) {
      is_of_points_ = keyword == "POINT_DATA";
      tuples_ = count(words[1]);
      break;
    } else if (keyword == "METADATA") {
      skip_metadata();
    } else if (keyword == "FIELD" && words.size() == 3) {
      field_arrays_ = count(words[2]);
      while (const std::optional<LegacyArray> array = next_of_field()) skip(*array);
    } else {
      fail("DIMENSIONS, ORIGIN, SPACING, POINT_DATA, or FIELD with a name and a number of arrays");
    }
  }
  if (!has_dims) bytes_.fail("the header has no line DIMENSIONS");
  volume_.index_to_world = affine_of(spacing, origin);
}

std::optional<LegacyArray> LegacyFile::attribute(const std::vector<std::string>& words, const std::string& keyword) {
  LegacyArray array{words.size() > 1 ? words[1] : "", StoredType::kU8, 1, tuples_, is_of_points_};
  if (keyword == "SCALARS" && (words.size() == 3 || words.size() == 4)) {
    array.type = type(words[2]);
    if (words.size() == 4) array.components = count(words[3]);
    const std::vector<std::string> table = next_words();
    if (table.empty() || in_capitals(table[0]) != "LOOKUP_TABLE") fail("LOOKUP_TABLE after SCALARS");
    return array;
  }
  if ((keyword == "VECTORS" || keyword == "NORMALS") && words.size() == 3) {
    array.type = type(words[2]);
    array.components = 3;
    return array;
  }
  if (keyword == "TENSORS" && words.size() == 3) {
    array.type = type(words[2]);
    array.components = 9;
    return array;
  }
  if (keyword == "TEXTURE_COORDINATES" && words.size() == 4) {
    array.type = type(words[3]);
    array.components = count(words[2]);
    return array;
  }
  if (keyword == "COLOR_SCALARS" && words.size() == 3) {
    array.components = count(words[2]);
    array.is_color = true;
    return array;
  }
  return std::nullopt;
}

// Up to a blank line, or the end.
void LegacyFile::skip_metadata() {
  std::optional<std::string> line = bytes_.read_line();
  while (line && !words_of(*line).empty()) line = bytes_.read_line();
}

// The next array of the field that was begun; nothing after its last one.
std::optional<LegacyArray> LegacyFile::next_of_field() {
  while (field_arrays_ > 0) {
    const std::vector<std::string> words = next_words();
    if (words.empty()) {
      bytes_.fail("the file ends where " + std::to_string(field_arrays_) + (field_arrays_ == 1 ? " array" : " arrays") +
                  " of a FIELD should follow, expected a line with a name, the components, the number and the type");
    }
    const std::string keyword = in_capitals(words[0]);
    if (words.size() == 1 && keyword == "METADATA") {
      skip_metadata();
      continue;
    }
    if (words.size() == 1 && keyword == "NULL_ARRAY") {  // for an array that the writer did not have
      --field_arrays_;
      continue;
    }
    if (words.size() != 4) fail("the name, the components, the number and the type of an array of the field");
    LegacyArray array{words[0], StoredType::kU8, count(words[1]), count(words[2]), is_of_points_};
    const std::string type_name = in_capitals(words[3]);
    if (type_name == "STRING" || type_name == "UTF8_STRING") {
      array.kind = LegacyArray::Kind::kText;
    } else if (type_name == "VARIANT") {
      array.kind = LegacyArray::Kind::kLines;
    } else if (type_name == "BIT") {
      array.kind = LegacyArray::Kind::kBits;
    } else {
      array.type = type(words[3]);
    }
    --field_arrays_;
    return array;
  }
  return std::nullopt;
}

std::optional<LegacyArray> LegacyFile::next() {
  if (std::optional<LegacyArray> array = next_of_field()) return array;
  for (std::vector<std::string> words = next_words(); !words.empty(); words = next_words()) {
    const std::string keyword = in_capitals(words[0]);
    if (keyword == "METADATA") {
      skip_metadata();
    } else if ((keyword == "POINT_DATA" || keyword == "CELL_DATA") && words.size() == 2) {
      is_of_points_ = keyword == "POINT_DATA";
      tuples_ = count(words[1]);
    } else if (keyword == "FIELD" && words.size() == 3) {
      field_arrays_ = count(words[2]);
      if (std::optional<LegacyArray> array = next_of_field()) return array;
    } else if (keyword == "LOOKUP_TABLE" && words.size() == 3) {
      skip({words[1], is_text_ ? StoredType::kF32 : StoredType::kU8, 4, count(words[2]), false});
    } else if (auto array = attribute(words, keyword)) {
      return array;
    } else {
      fail("SCALARS, VECTORS, FIELD or another kind of point data");
    }
  }
  return std::nullopt;
}

void LegacyFile::skip(const LegacyArray& array) {
  using Kind = LegacyArray::Kind;
  constexpr std::uint64_t kMost = std::uint64_t{1} << 58;
  if (array.components > 0 && array.tuples > kMost / array.components) fail("fewer numbers");
  const std::uint64_t numbers = array.components * array.tuples;
  if (!is_text_ && array.kind == Kind::kText) return skip_packed_text(array, numbers);
  if (!is_text_ && array.kind != Kind::kLines) {
    const std::uint64_t bytes = array.kind == Kind::kBits ? (numbers + 7) / 8 : numbers * stored_size(array.type);
    return bytes_.skip(bytes, "the end of the array " + in_quotes(array.name));
  }
  // An array of text begins with a line of its own. Each of its texts is a line, which may be empty.
  const bool is_of_lines = array.kind == Kind::kText || array.kind == Kind::kLines;
  for (std::uint64_t n = 0; n < numbers;) {
    const std::optional<std::string> line = bytes_.read_line();
    if (!line) bytes_.fail("the file ends within the values of the array " + in_quotes(array.name));
    n += is_of_lines ? 1 : words_of(*line).size();
  }
}

// In binary files the length of each text comes first: its two highest bits tell in how many bytes, 8, 4, 2 or 1.
void LegacyFile::skip_packed_text(const LegacyArray& array, std::uint64_t texts) {
  const std::string what = "the end of the array " + in_quotes(array.name);
  for (std::uint64_t n = 0; n < texts; ++n) {
    const auto first = std::to_integer<unsigned>(bytes_.take(1, what).front());
    std::uint64_t length = first & 0x3Fu;
    for (const std::byte next : bytes_.take((std::size_t{8} >> (first >> 6)) - 1, what)) {
      length = length << 8 | std::to_integer<std::uint64_t>(next);
    }
    bytes_.skip(length, what);
  }
}

}  // namespace deliso
