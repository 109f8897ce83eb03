#include "volume/io/vtk/legacy_vtk.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"
#include "volume/io/vtk/array_choice.h"
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

struct LegacyArray {
  std::string name;
  StoredType type = StoredType::kU8;
  std::uint64_t components = 1;
  std::uint64_t tuples = 0;
  bool is_of_points = false;
  bool is_color = false;  // as text: bytes as fractions of 255
};

// Goes through a file once: its header, then one array after another.
class LegacyFile {
 public:
  LegacyFile(ByteStream& bytes, VolumeDescription& volume) : bytes_(bytes), volume_(volume) { read_header(); }

  [[nodiscard]] bool is_text() const { return is_text_; }
  // The next array; the stream is then at its first number. Nothing at the end.
  std::optional<LegacyArray> next();
  // Goes over the numbers of an array.
  void skip(const LegacyArray& array);

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    bytes_.fail("the file has the line " + in_quotes(line_) + ", expected " + expected);
  }
  // The words of the next line that has any; none at the end.
  std::vector<std::string> next_words() {
    while (std::optional<std::string> line = bytes_.read_line()) {
      line_ = std::move(*line);
      std::vector<std::string> words = words_of(line_);
      if (!words.empty()) return words;
    }
    return {};
  }
  [[nodiscard]] std::uint64_t count(const std::string& word) const {
    std::int64_t value = 0;
    constexpr std::int64_t kMost = std::int64_t{1} << 40;
    if (!parse_word(word, value) || value < 0 || value > kMost) fail("whole numbers from 0 to 2^40");
    return static_cast<std::uint64_t>(value);
  }
  [[nodiscard]] StoredType type(const std::string& word) const {
    const std::optional<StoredType> found = legacy_vtk_type(word);
    if (!found) fail("a type of numbers: unsigned_char, short, float, ...");
    return *found;
  }
  [[nodiscard]] Vec3 three(const std::vector<std::string>& words) const {
    Vec3 out;
    if (words.size() != 4) fail("three numbers");
    for (std::size_t n = 0; n < 3; ++n) {
      if (!parse_word(words[n + 1], out[n]) || !std::isfinite(out[n])) fail("three finite numbers");
    }
    return out;
  }
  void read_header();
  std::optional<LegacyArray> attribute(const std::vector<std::string>& words, const std::string& keyword);

  ByteStream& bytes_;
  VolumeDescription& volume_;
  std::string line_;
  bool is_text_ = false;
  bool is_of_points_ = false;
  std::uint64_t tuples_ = 0;
  std::uint64_t field_arrays_ = 0;  // that are still to come
};

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
      for (std::size_t n = 0; n < 3; ++n) volume_.layout.dims.at(n) = dimension_of(bytes_, count(words[n + 1]));
      has_dims = true;
    } else if (keyword == "ORIGIN") {
      origin = three(words);
    } else if (keyword == "SPACING" || keyword == "ASPECT_RATIO") {
      spacing = three(words);
    } else if ((keyword == "POINT_DATA" || keyword == "CELL_DATA") && words.size() == 2) {
      is_of_points_ = keyword == "POINT_DATA";
      tuples_ = count(words[1]);
      break;
    } else {
      fail("DIMENSIONS, ORIGIN, SPACING or POINT_DATA");
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

std::optional<LegacyArray> LegacyFile::next() {
  for (std::vector<std::string> words = next_words(); !words.empty(); words = next_words()) {
    const std::string keyword = in_capitals(words[0]);
    if (keyword == "METADATA") {  // up to a blank line
      for (std::optional<std::string> line = bytes_.read_line(); line && !line->empty();) line = bytes_.read_line();
      continue;
    }
    if (field_arrays_ > 0) {
      if (words.size() != 4) fail("the name, the components, the number and the type of an array of the field");
      --field_arrays_;
      return LegacyArray{words[0], type(words[3]), count(words[1]), count(words[2]), is_of_points_};
    }
    if ((keyword == "POINT_DATA" || keyword == "CELL_DATA") && words.size() == 2) {
      is_of_points_ = keyword == "POINT_DATA";
      tuples_ = count(words[1]);
    } else if (keyword == "FIELD" && words.size() == 3) {
      field_arrays_ = count(words[2]);
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
  constexpr std::uint64_t kMost = std::uint64_t{1} << 58;
  if (array.components > 0 && array.tuples > kMost / array.components) fail("fewer numbers");
  const std::uint64_t numbers = array.components * array.tuples;
  if (!is_text_) return bytes_.skip(numbers * stored_size(array.type), "the next array");
  // An array of text begins with a line of its own.
  for (std::uint64_t n = 0; n < numbers;) {
    const std::optional<std::string> line = bytes_.read_line();
    if (!line) bytes_.fail("the file ends within the numbers of the array " + in_quotes(array.name));
    n += words_of(*line).size();
  }
}

// Colours in text are bytes as fractions of 255.
std::string bytes_of_colors(ByteStream& stream, std::uint64_t count) {
  const std::string numbers = bytes_of_numbers(stream, StoredType::kF32, count, true);
  std::string out;
  for (std::size_t place = 0; place < numbers.size(); place += sizeof(float)) {
    float fraction = 0;
    std::memcpy(&fraction, numbers.data() + place, sizeof fraction);
    if (!(fraction >= 0 && fraction <= 1)) stream.fail("COLOR_SCALARS has a number that is not from 0 to 1");
    out += static_cast<char>(static_cast<std::uint8_t>(std::lround(fraction * 255.0f)));
  }
  return out;
}

}  // namespace

Volume read_legacy_vtk(UnpackedFile& file, const ChannelChoice& choice, const std::string& array) {
  // First the names of all arrays, then the one.
  std::vector<LegacyArray> arrays;
  {
    VolumeDescription ignored;
    LegacyFile legacy(file.bytes(), ignored);
    while (std::optional<LegacyArray> next = legacy.next()) {
      legacy.skip(*next);
      arrays.push_back(std::move(*next));
    }
  }
  std::vector<std::string> names;
  for (const LegacyArray& each : arrays) {
    if (each.is_of_points) names.push_back(each.name);
  }
  const std::string name = names.at(choose_array(file.bytes(), names, array));
  file.rewind();
  VolumeDescription volume;
  volume.format = "VTK";
  LegacyFile legacy(file.bytes(), volume);
  std::optional<LegacyArray> found = legacy.next();
  for (; found && !(found->is_of_points && found->name == name); found = legacy.next()) legacy.skip(*found);
  ByteStream& bytes = file.bytes();
  if (!found) bytes.fail("the file has no array " + in_quotes(name));
  SampleLayout& layout = volume.layout;
  if (found->tuples != sample_count_of(bytes, layout.dims))
    bytes.fail("the array " + in_quotes(name) + " has " + std::to_string(found->tuples) +
               " values, but DIMENSIONS needs " + std::to_string(sample_count_of(bytes, layout.dims)));
  layout.type = found->type;
  layout.components = found->components;
  layout.endian = Endian::kBig;
  layout.may_go_on = true;
  if (!legacy.is_text()) return read_described(bytes, volume, choice, file.mappable());
  layout.endian = kHostEndian;
  choose_channel(bytes, choice, layout);
  const std::uint64_t numbers = found->tuples * found->components;
  MemoryStream text(
      bytes, found->is_color ? bytes_of_colors(bytes, numbers) : bytes_of_numbers(bytes, layout.type, numbers, true));
  return read_described(text, volume, choice);
}

}  // namespace deliso
