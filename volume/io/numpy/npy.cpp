#include "volume/io/numpy/npy.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"

namespace deliso {

namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

// The header, a dictionary as Python writes it: {'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 4), }.
class NpyHeader {
 public:
  explicit NpyHeader(ByteStream& file) : file_(file) {
    constexpr std::size_t kStart = 8, kLengthBytes = 2;
    const HeaderBytes start(file.take(kStart + kLengthBytes, "the header"));
    if (start.text(0, kNpyMagic.size()) != kNpyMagic)
      file.fail("the file starts with " + in_quotes(start.text(0, kNpyMagic.size())) + ", expected \\x93NUMPY");
    const int version = start.at<std::uint8_t>(6);
    if (version < 1 || version > 3)
      file.fail("the format version is " + std::to_string(version) + ", expected 1, 2 or 3");
    std::uint32_t length = start.at<std::uint8_t>(8) + 256u * start.at<std::uint8_t>(9);
    if (version > 1) {
      const HeaderBytes more(file.take(2, "the header"));
      length += 65536u * more.at<std::uint8_t>(0) + 16777216u * more.at<std::uint8_t>(1);
    }
    const HeaderBytes dictionary(file.take(length, "the header"));
    text_ = dictionary.text(0, length);
  }

  // What stands behind a key: a tuple with its parentheses, or all up to the comma or brace that ends it.
  [[nodiscard]] std::string value(const std::string& key) const {
    std::size_t at = text_.find("'" + key + "'");
    if (at == std::string::npos) file_.fail("the header has no entry '" + key + "'");
    at = text_.find(':', at);
    if (at == std::string::npos) file_.fail("the header's entry '" + key + "' has no value");
    at = text_.find_first_not_of(' ', at + 1);
    if (at == std::string::npos) file_.fail("the header's entry '" + key + "' has no value");
    const std::size_t end = text_[at] == '(' ? text_.find(')', at) : text_.find_first_of(",}", at);
    if (end == std::string::npos) file_.fail("the header's entry '" + key + "' does not end");
    return text_.substr(at, end - at + (text_[end] == ')' ? 1 : 0));
  }
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
    file_.fail("'" + key + "' is " + in_quotes(value(key)) + ", expected " + expected);
  }
  [[nodiscard]] std::vector<std::int64_t> shape() const {
    std::vector<std::int64_t> sizes;
    std::string word;
    const std::string tuple = value("shape");
    if (!tuple.starts_with('(')) fail("shape", "a tuple like (4, 5, 6)");
    for (const char c : tuple.substr(1, tuple.size() - 2) + ',') {
      if (c == ' ') continue;
      if (c != ',') {
        word += c;
        continue;
      }
      if (word.empty()) continue;  // behind the last comma
      std::int64_t size = 0;
      if (!parse_word(word, size)) fail("shape", "whole numbers");
      sizes.push_back(size);
      word.clear();
    }
    return sizes;
  }

 private:
  ByteStream& file_;
  std::string text_;
};

void take_npy_type(const NpyHeader& header, SampleLayout& layout) {
  static const std::map<std::string, StoredType> kTypes{
      {"u1", StoredType::kU8},  {"i1", StoredType::kI8},  {"u2", StoredType::kU16}, {"i2", StoredType::kI16},
      {"u4", StoredType::kU32}, {"i4", StoredType::kI32}, {"u8", StoredType::kU64}, {"i8", StoredType::kI64},
      {"f2", StoredType::kF16}, {"f4", StoredType::kF32}, {"f8", StoredType::kF64}, {"b1", StoredType::kBool},
      {"c8", StoredType::kF32}, {"c16", StoredType::kF64}};
  const std::string text = header.value("descr");
  const char* const expected = "'<f4', '|u1', '>i2' or another type of numbers";
  if (text.size() < 4 || text.front() != '\'' || text.back() != '\'') header.fail("descr", expected);
  const char order = text[1];
  const auto type = kTypes.find(text.substr(2, text.size() - 3));
  if (type == kTypes.end() || (order != '<' && order != '>' && order != '|' && order != '='))
    header.fail("descr", expected);
  layout.type = type->second;
  layout.endian = order == '>' ? Endian::kBig : order == '<' ? Endian::kLittle : kHostEndian;
  if (type->first.front() == 'c') layout.components = 2;
}

void take_npy_shape(const ByteStream& file, const NpyHeader& header, SampleLayout& layout) {
  const std::vector<std::int64_t> shape = header.shape();
  if (shape.size() != 3 && shape.size() != 4) header.fail("shape", "three axes (z, y, x), or four with channels");
  const std::string order = header.value("fortran_order");
  if (order != "True" && order != "False") header.fail("fortran_order", "True or False");
  layout.is_z_fastest = order == "True";
  const bool is_vector = shape.size() == 4 && shape.back() < shape.front();
  const std::size_t first = shape.size() == 4 && !is_vector ? 1 : 0;  // the axis z
  for (std::size_t n = 0; n < 3; ++n)
    layout.dims[2 - n] = dimension_of(file, along_axis("'shape'", 2 - n), shape[first + n]);
  if (shape.size() == 3) return;
  const auto channels = static_cast<std::uint64_t>(
      dimension_of(file, "the number of channels in 'shape'", is_vector ? shape.back() : shape.front()));
  // In C order the last axis is the fastest, in Fortran order the first.
  (is_vector != layout.is_z_fastest ? layout.components : layout.volumes) *= channels;
}

}  // namespace

Volume read_npy(UnpackedFile& file, const ChannelChoice& choice) {
  const NpyHeader header(file.bytes());
  VolumeDescription volume;
  volume.format = "NumPy";
  take_npy_type(header, volume.layout);
  take_npy_shape(file.bytes(), header, volume.layout);
  return read_described(file.bytes(), volume, choice, file.mappable());
}

}  // namespace deliso
