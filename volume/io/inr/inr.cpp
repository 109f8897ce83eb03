#include "volume/io/inr/inr.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"

namespace deliso {

namespace {

// The lines KEY=value between the magic and the line that ends with ##}.
class InrFields {
 public:
  explicit InrFields(ByteStream& file) : file_(file) {
    const std::string magic = file.read_line().value_or("");
    if (!magic.starts_with("#INRIMAGE-4#{"))
      file.fail("the file starts with " + in_quotes(magic) + ", expected #INRIMAGE-4#{");
    constexpr int kMostLines = 10000;
    for (int n = 0; n < kMostLines; ++n) {
      const std::optional<std::string> line = file.read_line();
      if (!line) break;
      if (line->find("##}") != std::string::npos) return;
      const std::size_t equals = line->find('=');
      if (line->empty() || line->front() == '#' || equals == std::string::npos) continue;
      fields_[without_blanks(line->substr(0, equals))] = without_blanks(line->substr(equals + 1));
    }
    file.fail("the header does not end: expected a line with ##}");
  }

  [[nodiscard]] std::string text(const std::string& key, const std::string& fallback) const {
    const auto place = fields_.find(key);
    return place == fields_.end() ? fallback : place->second;
  }
  [[nodiscard]] double number(const std::string& key, double fallback) const {
    double value = fallback;
    if (fields_.contains(key) && (!parse_word(fields_.at(key), value) || !std::isfinite(value)))
      fail(key, "a finite number");
    return value;
  }
  [[nodiscard]] std::int64_t integer(const std::string& key, std::int64_t fallback) const {
    std::int64_t value = fallback;
    if (fields_.contains(key) && !parse_word(fields_.at(key), value)) fail(key, "a whole number");
    return value;
  }
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
    file_.fail(key + " is " + in_quotes(text(key, "")) + ", expected " + expected);
  }

 private:
  // At both ends.
  static std::string without_blanks(const std::string& text) {
    constexpr const char* kBlanks = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  }

  ByteStream& file_;
  std::map<std::string, std::string> fields_;
};

StoredType read_inr_type(const InrFields& fields) {
  const std::string kind = fields.text("TYPE", ""), size = fields.text("PIXSIZE", "8 bits");
  const std::string bits = size.substr(0, size.find(' '));
  static const std::map<std::string, StoredType> kTypes{
      {"unsigned fixed 8", StoredType::kU8},   {"unsigned fixed 16", StoredType::kU16},
      {"unsigned fixed 32", StoredType::kU32}, {"unsigned fixed 64", StoredType::kU64},
      {"signed fixed 8", StoredType::kI8},     {"signed fixed 16", StoredType::kI16},
      {"signed fixed 32", StoredType::kI32},   {"signed fixed 64", StoredType::kI64},
      {"float 32", StoredType::kF32},          {"float 64", StoredType::kF64}};
  const auto type = kTypes.find(kind + " " + bits);
  if (type != kTypes.end()) return type->second;
  if (kind != "unsigned fixed" && kind != "signed fixed" && kind != "float")
    fields.fail("TYPE", "unsigned fixed, signed fixed or float");
  fields.fail("PIXSIZE", "8, 16, 32 or 64 bits (32 or 64 for floats)");
}

void take_inr_scale(const InrFields& fields, SampleLayout& layout) {
  const std::string scale = fields.text("SCALE", "2**0");
  if (layout.type == StoredType::kF32 || layout.type == StoredType::kF64 || scale.empty()) return;
  std::int64_t exponent = 0;
  constexpr std::int64_t kLargest = 500;
  if (!scale.starts_with("2**") || !parse_word(std::string_view(scale).substr(3), exponent) ||
      std::abs(exponent) > kLargest)
    fields.fail("SCALE", "a power of two like 2**0");
  if (exponent != 0) layout.scale = {std::ldexp(1.0, static_cast<int>(exponent)), 0.0};
}

}  // namespace

Volume read_inr(UnpackedFile& file, const ChannelChoice& choice) {
  ByteStream& stream = file.bytes();
  const InrFields fields(stream);
  VolumeDescription volume;
  volume.format = "INR";
  SampleLayout& layout = volume.layout;
  layout.type = read_inr_type(fields);
  layout.dims = {dimension_of(stream, "XDIM", fields.integer("XDIM", 0)),
                 dimension_of(stream, "YDIM", fields.integer("YDIM", 0)),
                 dimension_of(stream, "ZDIM", fields.integer("ZDIM", 1))};
  layout.components = static_cast<std::uint64_t>(dimension_of(stream, "VDIM", fields.integer("VDIM", 1)));
  const std::string cpu = fields.text("CPU", "decm");
  layout.endian = cpu == "sun" || cpu == "sgi" ? Endian::kBig : Endian::kLittle;
  if (cpu != "sun" && cpu != "sgi" && cpu != "decm" && cpu != "alpha" && cpu != "pc")
    fields.fail("CPU", "decm, alpha, pc, sun or sgi");
  take_inr_scale(fields, layout);
  for (const char* const key : {"RX", "RY", "RZ"}) {
    if (fields.number(key, 0) != 0) fields.fail(key, "0: rotated volumes are read from NRRD, NIfTI or MetaImage");
  }
  const Vec3 spacing{fields.number("VX", 1), fields.number("VY", 1), fields.number("VZ", 1)};
  for (std::size_t n = 0; n < 3; ++n) {
    if (!(spacing[n] > 0)) fields.fail(std::string("V") + "XYZ"[n], "a number above 0");
  }
  volume.index_to_world = affine_of(spacing, {fields.number("TX", 0), fields.number("TY", 0), fields.number("TZ", 0)});
  return read_described(stream, volume, choice, file.mappable());
}

}  // namespace deliso
