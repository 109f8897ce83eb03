// Reads PolyData of VTK's legacy format, versions 1 to 5.1: points, polygons, strips. Of the values of points and cells
// behind them the labels of cells are kept.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/polygon_lists.h"
#include "surface/mesh/io/text.h"
#include "surface/mesh/io/vtk_numbers.h"
#include "volume/io/vtk/vtk_types.h"
#include "volume/sample_type.h"

namespace deliso {

namespace {

class LegacyVtkParser {
 public:
  LegacyVtkParser(std::string_view bytes, const std::string& file, MeshComments* comments)
      : bytes_(bytes), file_(file), comments_(comments) {}

  TriangleMesh parse() {
    read_head();
    while (std::optional<std::vector<std::string_view>> words = next_words()) {
      const std::string_view keyword = (*words)[0];
      if (same_letters(keyword, "POINT_DATA") || same_letters(keyword, "CELL_DATA")) {
        read_labels(*words);
        break;
      }
      read_section(*words);
    }
    if (!has_points_) fail("the keyword POINTS", "");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const {
    constexpr std::size_t kLongest = 40;
    std::string what(found.substr(0, kLongest));
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
    throw InputError(file_ + ", byte " + std::to_string(position_) + ": expected " + expected + ", found " +
                     (what.empty() ? "nothing" : "'" + what + "'"));
  }

  // The rest of the line, without its end; none at the end of the file.
  std::optional<std::string_view> next_row() {
    if (position_ >= bytes_.size()) return std::nullopt;
    const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
    std::string_view line = bytes_.substr(position_, end - position_);
    position_ = std::min(end + 1, bytes_.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  // The words of the next line that has any.
  std::optional<std::vector<std::string_view>> next_words() {
    while (const std::optional<std::string_view> line = next_row()) {
      TextScanner scanner(*line, file_);
      std::vector<std::string_view> words;
      for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) words.push_back(word);
      if (!words.empty()) return words;
    }
    return std::nullopt;
  }
  std::int64_t count(std::string_view word) const {
    constexpr std::int64_t kMost = std::int64_t{1} << 40;
    std::int64_t value = 0;
    if (!parse_integer(word, value) || value < 0 || value > kMost) fail("a whole number from 0 to 2^40", word);
    return value;
  }

  void read_head() {
    const std::string_view first = next_row().value_or("");
    if (!first.starts_with("# vtk DataFile Version")) fail("the line '# vtk DataFile Version 3.0'", first);
    static_cast<void>(next_row());  // the title
    const auto encoding = next_words();
    is_text_ = encoding && encoding->size() == 1 && same_letters(encoding->front(), "ASCII");
    const bool is_binary = encoding && encoding->size() == 1 && same_letters(encoding->front(), "BINARY");
    if (!is_text_ && !is_binary) fail("ASCII or BINARY", encoding ? encoding->front() : "");
    const auto dataset = next_words();
    const bool is_dataset = dataset && dataset->size() == 2 && same_letters(dataset->front(), "DATASET");
    if (!is_dataset || !same_letters(dataset->back(), "POLYDATA"))
      fail("DATASET POLYDATA: other data sets are no triangle meshes", dataset ? dataset->back() : "");
  }

  void read_section(const std::vector<std::string_view>& words) {
    const std::string_view keyword = words[0];
    if (same_letters(keyword, "METADATA")) {  // up to a blank line
      for (auto line = next_row(); line && !line->empty();) line = next_row();
    } else if (same_letters(keyword, "FIELD") && words.size() == 3) {
      for (std::int64_t left = count(words[2]); left > 0; --left) read_field_array(nullptr);
    } else if (same_letters(keyword, "POINTS") && words.size() == 3) {
      read_points(count(words[1]), type_of(words[2]));
    } else if (words.size() == 3 && (same_letters(keyword, "POLYGONS") || same_letters(keyword, "TRIANGLE_STRIPS") ||
                                     same_letters(keyword, "VERTICES") || same_letters(keyword, "LINES"))) {
      const bool is_wanted = !same_letters(keyword, "VERTICES") && !same_letters(keyword, "LINES");
      read_cells(count(words[1]), count(words[2]), is_wanted, same_letters(keyword, "TRIANGLE_STRIPS"));
    } else {
      fail("POINTS, POLYGONS, TRIANGLE_STRIPS, FIELD or POINT_DATA", keyword);
    }
  }

  StoredType type_of(std::string_view word) const {
    const std::optional<StoredType> type = legacy_vtk_type(word);
    if (!type) fail("a type of numbers (float, double, int, vtktypeint64, ...)", word);
    return *type;
  }

  // Calls take(value) for each of `count` numbers; those of binary data are big-endian.
  template <class Take>
  void read_numbers(std::int64_t count, StoredType type, const Take& take) {
    if (is_text_) {
      TextScanner in(bytes_.substr(position_), file_);
      for (std::int64_t i = 0; i < count; ++i) {
        const std::string_view word = in.word();
        double value = 0;
        if (!parse_number(word, value)) {
          position_ += in.position();
          fail("a number", word);
        }
        take(value);
      }
      position_ += in.position();
      return;
    }
    ByteReader in(bytes_, file_, std::endian::big, position_);
    for (std::int64_t i = 0; i < count; ++i) take(number_of_type(in, type));
    position_ = in.position();
  }
  void read_points(std::int64_t count, StoredType type) {
    if (has_points_) fail("the keyword POINTS once", "POINTS");
    has_points_ = true;
    if (count >= std::numeric_limits<std::uint32_t>::max()) fail("fewer than 2^32 - 1 points", std::to_string(count));
    std::size_t axis = 0;
    Vec3 p;
    mesh_.points.reserve(std::min(static_cast<std::size_t>(count), bytes_.size() / 3));
    read_numbers(3 * count, type, [&](double value) {
      if (!std::isfinite(value)) fail("a finite coordinate", std::to_string(value));
      p[axis++] = value;
      if (axis < 3) return;
      mesh_.points.push_back(p);
      axis = 0;
    });
  }

  std::vector<std::int64_t> whole_numbers(std::int64_t count, StoredType type) {
    std::vector<std::int64_t> numbers;
    numbers.reserve(std::min(static_cast<std::size_t>(count), bytes_.size()));
    read_numbers(count, type, [&](double value) {
      if (!(value >= 0 && value <= 0x1p52 && value == std::floor(value)))
        fail("a whole number of at least 0", std::to_string(value));
      numbers.push_back(static_cast<std::int64_t>(value));
    });
    return numbers;
  }

  // Up to version 4 each cell is its number of corners and these, in all `size` numbers; from 5.1 on `cells` is one
  // more than there are, and two lists follow: where each cell begins, and `size` corners.
  void read_cells(std::int64_t cells, std::int64_t size, bool is_wanted, bool are_strips) {
    std::vector<std::int64_t> corners, ends;
    if (same_letters(bytes_.substr(position_, 8), "OFFSETS ")) {
      const auto words = next_words();
      if (words->size() != 2) fail("OFFSETS and a type", words->back());
      ends = whole_numbers(cells, type_of(words->back()));
      const auto next = next_words();
      if (!next || next->size() != 2 || !same_letters(next->front(), "CONNECTIVITY"))
        fail("CONNECTIVITY and a type", next ? next->front() : "");
      corners = whole_numbers(size, type_of((*next)[1]));
      if (!ends.empty() && ends.front() != 0) fail("cells that begin at 0", std::to_string(ends.front()));
      if (!ends.empty()) ends.erase(ends.begin());
    } else {
      const std::vector<std::int64_t> rows = whole_numbers(size, StoredType::kI32);
      std::size_t at = 0;
      for (std::int64_t cell = 0; cell < cells; ++cell) {
        if (at >= rows.size() || static_cast<std::size_t>(rows[at]) >= rows.size() - at)
          fail("cells of " + std::to_string(size) + " numbers in all", std::to_string(cells) + " cells");
        const auto length = static_cast<std::size_t>(rows[at]);
        for (std::size_t k = 1; k <= length; ++k) corners.push_back(rows[at + k]);
        ends.push_back(static_cast<std::int64_t>(corners.size()));
        at += length + 1;
      }
    }
    if (!is_wanted) {
      cells_.before += ends.size();
      return;
    }
    append_polygons(
        corners, ends, are_strips, 0, static_cast<std::int64_t>(mesh_.points.size()),
        [this](const std::string& expected, std::int64_t found) { fail(expected, std::to_string(found)); }, mesh_,
        cells_);
  }

  // Of fields, which hold ours, and of scalars, which others make of them. Values are no reason to refuse a mesh.
  void read_labels(std::vector<std::string_view> words) {
    std::vector<double> labels;
    try {
      std::int64_t tuples = 0;
      for (bool of_cells = false; labels.empty();) {
        const std::string_view keyword = words[0];
        if (same_letters(keyword, "POINT_DATA") || same_letters(keyword, "CELL_DATA")) {
          of_cells = same_letters(keyword, "CELL_DATA");
          tuples = words.size() == 2 ? count(words[1]) : 0;
        } else if (same_letters(keyword, "FIELD") && words.size() == 3) {
          for (std::int64_t left = count(words[2]); left > 0; --left) read_field_array(of_cells ? &labels : nullptr);
        } else if (same_letters(keyword, "SCALARS") && (words.size() == 3 || words.size() == 4)) {
          const std::int64_t components = words.size() == 4 ? count(words[3]) : 1;
          static_cast<void>(next_words());  // the name of a table
          read_array(words[1], components, tuples, words[2], of_cells ? &labels : nullptr);
        } else if (same_letters(keyword, "METADATA")) {
          read_section(words);
        } else {
          break;
        }
        const auto next = next_words();
        if (!next) break;
        words = *next;
      }
    } catch (const InputError&) {  // what was found before it is kept
    }
    if (!labels.empty()) append_labels(cells_, labels, mesh_);
  }

  void read_field_array(std::vector<double>* labels) {
    const auto words = next_words();
    if (!words || words->size() != 4) fail("name, components, number and type of an array", words ? (*words)[0] : "");
    read_array((*words)[0], count((*words)[1]), count((*words)[2]), (*words)[3], labels);
  }
  // An array of labels goes into `labels`, if given.
  void read_array(std::string_view name, std::int64_t components, std::int64_t tuples, std::string_view type,
                  std::vector<double>* labels) {
    constexpr std::int64_t kMost = std::int64_t{1} << 48;
    if (components > 0 && tuples > kMost / components) fail("fewer numbers", std::to_string(tuples));
    if (!same_letters(type, "STRING")) {
      const bool is_label = labels != nullptr && name == kLabelArray && components == 1;
      std::vector<double> values;
      read_numbers(components * tuples, type_of(type), [&](double value) {
        if (is_label) values.push_back(value);
      });
      if (is_label) *labels = std::move(values);
      return;
    }
    const bool is_kept = comments_ != nullptr && name == "comments";
    for (std::int64_t i = 0; i < components * tuples; ++i) {
      const std::string text = is_text_ ? text_row() : text_of_bytes();
      if (is_kept) comments_->push_back(text);
    }
  }
  std::string text_row() {
    const std::optional<std::string_view> line = next_row();
    if (!line) fail("another line of text", "");
    return percent_decoded(*line);
  }
  std::string text_of_bytes() {
    ByteReader in(bytes_, file_, std::endian::big, position_);
    const auto first = in.read<std::uint8_t>("the length of a text");
    std::uint64_t length = first & 0x3Fu;
    constexpr int kWays[] = {7, 3, 1, 0};  // more bytes of the length, by the two highest bits
    for (int i = 0; i < kWays[first >> 6]; ++i) length = length << 8 | in.read<std::uint8_t>("the length of a text");
    const std::size_t begin = in.position();
    in.skip(static_cast<std::size_t>(std::min<std::uint64_t>(length, bytes_.size() + 1)), "a text");
    position_ = in.position();
    return std::string(bytes_.substr(begin, static_cast<std::size_t>(length)));
  }

  std::string_view bytes_;
  std::string file_;
  MeshComments* comments_;
  std::size_t position_ = 0;
  bool is_text_ = false;
  bool has_points_ = false;
  CellNumbers cells_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_legacy_vtk(std::string_view bytes, const std::string& file, MeshComments* comments) {
  return LegacyVtkParser(bytes, file, comments).parse();
}

}  // namespace deliso
