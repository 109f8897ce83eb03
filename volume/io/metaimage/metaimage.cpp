#include "volume/io/metaimage/metaimage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "volume/io/base/file_row.h"
#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"

namespace deliso {

namespace {

// The lines `Key = value` up to ElementDataFile, which is the last.
class MetaFields {
 public:
  explicit MetaFields(ByteStream& file) : file_(file) {
    constexpr int kMostLines = 10000;
    for (int n = 1; n <= kMostLines; ++n) {
      std::optional<std::string> line = file.read_line();
      if (n == 1 && line && line->starts_with("\xEF\xBB\xBF")) line->erase(0, 3);
      if (!line) break;
      if (line->find_first_not_of(" \t") == std::string::npos) continue;
      const std::size_t equals = line->find_first_of("=:");
      if (equals == std::string::npos)
        file.fail("line " + std::to_string(n) + ": " + in_quotes(*line) +
                  " is no header line, expected \"Key = value\"");
      const std::string key = trimmed_text(line->substr(0, equals));
      const std::string value = trimmed_text(line->substr(equals + 1));
      const auto [known, is_new] = fields_.emplace(key, value);
      if (!is_new && known->second != value)
        file.fail("line " + std::to_string(n) + ": \"" + key + "\" is " + in_quotes(value) + ", but " +
                  in_quotes(known->second) + " in a line before, expected one value: delete one of the lines");
      if (key == "ElementDataFile") return;
    }
    file.fail("the header has no key \"ElementDataFile\", its last line");
  }

  [[nodiscard]] const std::string* find(const std::string& key) const {
    const auto place = fields_.find(key);
    return place == fields_.end() ? nullptr : &place->second;
  }
  [[nodiscard]] const std::string& required(const std::string& key) const {
    const std::string* value = find(key);
    if (value == nullptr) file_.fail("the header has no key \"" + key + "\"");
    return *value;
  }
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
    file_.fail("\"" + key + "\" is " + in_quotes(required(key)) + ", expected " + expected);
  }
  // `count` finite numbers; nothing when the key is missing.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count) const {
    const std::string* value = find(key);
    if (value == nullptr) return std::nullopt;
    std::vector<double> out;
    for (const std::string& word : words(*value)) {
      double number = 0;
      if (!parse_word(word, number) || !std::isfinite(number)) fail(key, std::to_string(count) + " finite numbers");
      out.push_back(number);
    }
    if (out.size() != count) fail(key, std::to_string(count) + " numbers, not " + std::to_string(out.size()));
    return out;
  }
  [[nodiscard]] std::int64_t integer(const std::string& key, std::int64_t fallback) const {
    const std::string* value = find(key);
    std::int64_t number = fallback;
    if (value != nullptr && !parse_word(*value, number)) fail(key, "a whole number");
    return number;
  }
  [[nodiscard]] bool is_true(const std::string& key) const {
    const std::string* value = find(key);
    return value != nullptr && !value->empty() && (value->front() == 'T' || value->front() == 't' || *value == "1");
  }

  static std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> out;
    std::string word;
    for (const char c : text + ' ') {
      if (c != ' ' && c != '\t') {
        word += c;
      } else if (!word.empty()) {
        out.push_back(std::exchange(word, {}));
      }
    }
    return out;
  }

 private:
  static std::string trimmed_text(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  }

  ByteStream& file_;
  std::map<std::string, std::string> fields_;
};

StoredType read_meta_type(const MetaFields& fields) {
  static const std::map<std::string, StoredType> kTypes{
      {"MET_CHAR", StoredType::kI8},        {"MET_UCHAR", StoredType::kU8},  {"MET_SHORT", StoredType::kI16},
      {"MET_USHORT", StoredType::kU16},     {"MET_INT", StoredType::kI32},   {"MET_UINT", StoredType::kU32},
      {"MET_LONG", StoredType::kI32},       {"MET_ULONG", StoredType::kU32}, {"MET_LONG_LONG", StoredType::kI64},
      {"MET_ULONG_LONG", StoredType::kU64}, {"MET_FLOAT", StoredType::kF32}, {"MET_DOUBLE", StoredType::kF64}};
  std::string name = fields.required("ElementType");
  if (name.ends_with("_ARRAY")) name.resize(name.size() - 6);
  const auto place = kTypes.find(name);
  if (place == kTypes.end()) fields.fail("ElementType", "MET_UCHAR, MET_SHORT, MET_FLOAT or another type of numbers");
  return place->second;
}

std::optional<std::vector<double>> first_of(const MetaFields& fields, std::initializer_list<const char*> keys,
                                            std::size_t count) {
  for (const char* const key : keys) {
    if (auto numbers = fields.numbers(key, count)) return numbers;
  }
  return std::nullopt;
}

// Axes beyond three count volumes.
std::size_t take_meta_dims(const ByteStream& file, const MetaFields& fields, SampleLayout& layout) {
  const std::int64_t axes = fields.integer("NDims", 0);
  if (axes != 3 && axes != 4) fields.fail("NDims", "3 or 4");
  const std::optional<std::vector<double>> sizes = fields.numbers("DimSize", static_cast<std::size_t>(axes));
  if (!sizes) static_cast<void>(fields.required("DimSize"));
  for (std::size_t n = 0; n < sizes->size(); ++n) {
    constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
    const double size = (*sizes)[n];
    if (!(size >= 1 && size <= kLargest) || size != std::floor(size)) fields.fail("DimSize", "whole numbers from 2 on");
    const std::int32_t whole = dimension_of(file, along_axis("DimSize", n), static_cast<std::int64_t>(size));
    if (n < 3) layout.dims[n] = whole;
    if (n == 3) layout.volumes = static_cast<std::uint64_t>(whole);
  }
  const std::int64_t channels = fields.integer("ElementNumberOfChannels", 1);
  if (channels < 1) fields.fail("ElementNumberOfChannels", "1 or more");
  layout.components = static_cast<std::uint64_t>(channels);
  return static_cast<std::size_t>(axes);
}

// Row n of the matrix is the direction of axis n.
void take_meta_geometry(const MetaFields& fields, std::size_t axes, VolumeDescription& volume) {
  Vec3 spacing{1, 1, 1};
  if (const auto found = first_of(fields, {"ElementSpacing", "ElementSize"}, axes))
    spacing = {(*found)[0], (*found)[1], (*found)[2]};
  for (std::size_t n = 0; n < 3; ++n) {
    if (!(spacing[n] != 0)) fields.fail(fields.find("ElementSpacing") ? "ElementSpacing" : "ElementSize", "no 0");
  }
  Affine& map = volume.index_to_world;
  if (const auto matrix = first_of(fields, {"TransformMatrix", "Rotation", "Orientation"}, axes * axes)) {
    for (std::size_t n = 0; n < 3; ++n)
      map.columns[n] = {(*matrix)[axes * n], (*matrix)[axes * n + 1], (*matrix)[axes * n + 2]};
  }
  for (std::size_t n = 0; n < 3; ++n) map.columns[n] = spacing[n] * map.columns[n];
  if (const auto offset = first_of(fields, {"Offset", "Position", "Origin"}, axes))
    map.offset = {(*offset)[0], (*offset)[1], (*offset)[2]};
  volume.space = space_name("LPS");
  volume.units = "mm";
}

// `name%03d.raw FIRST LAST STEP`: printf's names, one conversion.
std::vector<std::filesystem::path> numbered(const MetaFields& fields, const std::vector<std::string>& words,
                                            const std::filesystem::path& folder, std::uint64_t most) {
  const char* const expected = "LOCAL, a file name, LIST, or like \"name%03d.raw 1 50 1\"";
  const std::string& pattern = words[0];
  const std::size_t percent = pattern.find('%'), d = pattern.find('d', percent);
  std::int64_t width = 0, first = 0, last = 0, step = 0;
  if (d == std::string::npos || words.size() != 4 || !parse_word(words[1], first) || !parse_word(words[2], last) ||
      !parse_word(words[3], step) || step < 1 || first < 0 || last < first)
    fields.fail("ElementDataFile", expected);
  const std::string digits = pattern.substr(percent + 1, d - percent - 1);
  constexpr std::int64_t kWidest = 100;
  if (!digits.empty() && (!parse_word(digits, width) || width < 0 || width > kWidest))
    fields.fail("ElementDataFile", expected);
  if (static_cast<std::uint64_t>((last - first) / step) >= most) fields.fail("ElementDataFile", "fewer files");
  std::vector<std::filesystem::path> paths;
  for (std::int64_t n = first; n <= last; n += step) {
    std::string number = std::to_string(n);
    const auto wide = static_cast<std::size_t>(width);
    if (number.size() < wide) number.insert(0, wide - number.size(), digits.front() == '0' ? '0' : ' ');
    paths.push_back(folder / (pattern.substr(0, percent) + number + pattern.substr(d + 1)));
  }
  return paths;
}

// The files of the samples; none when they follow in the same file.
std::vector<std::filesystem::path> data_files(ByteStream& file, const MetaFields& fields,
                                              const std::filesystem::path& folder, std::uint64_t most) {
  const std::string& value = fields.required("ElementDataFile");
  const std::vector<std::string> words = MetaFields::words(value);
  if (words.empty()) fields.fail("ElementDataFile", "LOCAL or a file name");
  if (words[0] == "LOCAL" || words[0] == "Local" || words[0] == "local") return {};
  if (words[0] == "LIST") {
    std::vector<std::filesystem::path> paths;
    while (const std::optional<std::string> line = file.read_line()) {
      if (!line->empty()) paths.push_back(folder / *line);
      if (paths.size() > most) fields.fail("ElementDataFile", "no more files than samples");
    }
    if (paths.empty()) fields.fail("ElementDataFile", "a file name in each of the lines that follow");
    return paths;
  }
  if (words.size() > 1 && words[0].find('%') != std::string::npos) return numbered(fields, words, folder, most);
  return {folder / value};
}

// Where the samples begin: HeaderSize bytes are skipped; -1 says that they end the file.
void skip_header(InputFile& file, const MetaFields& fields, std::uint64_t bytes) {
  const std::int64_t skipped = fields.integer("HeaderSize", 0);
  if (skipped < -1) fields.fail("HeaderSize", "0 or more, or -1");
  if (skipped > 0) file.skip(static_cast<std::uint64_t>(skipped), "the first sample");
  if (skipped == -1 && bytes <= file.remaining()) file.seek(file.size() - bytes);
}

// The samples and what else a description needs, from the header's own file or from those that it names.
Volume read_meta_samples(UnpackedFile& file, const MetaFields& fields, const std::vector<std::filesystem::path>& files,
                         VolumeDescription volume, const ChannelChoice& choice) {
  ByteStream& bytes = file.bytes();
  SampleLayout& layout = volume.layout;
  const std::uint64_t values = sample_count_of(bytes, layout.dims) * layout.components * layout.volumes;
  if (files.size() > 1) {
    const std::int64_t skipped = fields.integer("HeaderSize", 0);
    if (skipped < 0) fields.fail("HeaderSize", "0 or more for data in several files");
    FileRow row(files, static_cast<std::uint64_t>(skipped), bytes);
    return read_described(row, volume, choice);
  }
  std::optional<UnpackedFile> detached;
  if (!files.empty()) {
    try {
      detached.emplace(files[0]);
    } catch (const InputError& error) {
      bytes.fail(std::string("the data file ") + error.what());
    }
    if (!detached->is_packed()) skip_header(detached->file(), fields, values * stored_size(layout.type));
    if (layout.compression == Compression::kGzip && detached->is_packed()) layout.compression = Compression::kNone;
  }
  UnpackedFile& data = detached ? *detached : file;
  if (fields.find("BinaryData") != nullptr && !fields.is_true("BinaryData")) {
    layout.endian = kHostEndian;
    MemoryStream text(data.bytes(), bytes_of_numbers(data.bytes(), layout.type, values));
    return read_described(text, volume, choice);
  }
  return read_described(data.bytes(), volume, choice, data.mappable());
}

}  // namespace

Volume read_metaimage(UnpackedFile& file, const ChannelChoice& choice) {
  ByteStream& bytes = file.bytes();
  const MetaFields fields(bytes);
  VolumeDescription volume;
  volume.format = "MetaImage";
  SampleLayout& layout = volume.layout;
  const std::size_t axes = take_meta_dims(bytes, fields, layout);
  layout.type = read_meta_type(fields);
  layout.endian = fields.is_true("BinaryDataByteOrderMSB") || fields.is_true("ElementByteOrderMSB") ? Endian::kBig
                                                                                                    : Endian::kLittle;
  take_meta_geometry(fields, axes, volume);
  check_geometry(bytes, volume);
  choose_channel(bytes, choice, layout);
  const std::uint64_t count = std::uint64_t{sample_count_of(bytes, layout.dims)};
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60;
  if (layout.components * layout.volumes > kMost / (count * stored_size(layout.type)))
    bytes.fail("the dimensions and the type need more bytes than memory can address");
  if (fields.is_true("CompressedData")) layout.compression = Compression::kGzip;

  constexpr std::uint64_t kMostFiles = 1 << 20;
  std::vector<std::filesystem::path> files =
      data_files(bytes, fields, file.file().path().parent_path(), std::min(count, kMostFiles));
  if (!files.empty()) file.require_folder();
  Volume read = read_meta_samples(file, fields, files, volume, choice);
  read.data_files = std::move(files);
  return read;
}

}  // namespace deliso
