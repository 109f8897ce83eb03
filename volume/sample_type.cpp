#include "volume/sample_type.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace deliso {

namespace {

struct Spellings {
  SampleType type;
  std::size_t size;
  std::string_view nrrd_name;
  std::array<std::string_view, 9> names;  // lower case, single blanks; unused slots are empty
};

constexpr std::array<Spellings, 7> kTypes{{
    {SampleType::kU8, 1, "uint8", {"uint8", "uint8_t", "uchar", "unsigned char", "u8"}},
    {SampleType::kI8, 1, "int8", {"int8", "int8_t", "signed char", "i8"}},
    {SampleType::kU16,
     2,
     "uint16",
     {"uint16", "uint16_t", "ushort", "unsigned short", "unsigned short int", "short unsigned int", "u16"}},
    {SampleType::kI16,
     2,
     "int16",
     {"int16", "int16_t", "short", "short int", "signed short", "signed short int", "i16"}},
    {SampleType::kI32, 4, "int32", {"int32", "int32_t", "int", "signed int", "signed", "i32"}},
    {SampleType::kF32, 4, "float", {"float", "float32", "f32"}},
    {SampleType::kF64, 8, "double", {"double", "float64", "f64"}},
}};

// Lower case, outer blanks dropped, inner runs of blanks made one.
std::string normalized(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool blank = c == ' ' || c == '\t';
    if (blank && (out.empty() || out.back() == ' ')) continue;
    out += blank ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

const Spellings& spellings(SampleType type) { return kTypes.at(static_cast<std::size_t>(type)); }

}  // namespace

std::optional<SampleType> parse_sample_type(std::string_view name) {
  const std::string wanted = normalized(name);
  if (wanted.empty()) return std::nullopt;
  for (const Spellings& type : kTypes)
    if (std::find(type.names.begin(), type.names.end(), wanted) != type.names.end()) return type.type;
  return std::nullopt;
}

std::string supported_sample_types() { return "uint8, int8, uint16, int16, int32, float or double"; }

std::size_t sample_size(SampleType type) { return spellings(type).size; }

std::string nrrd_type_name(SampleType type) { return std::string(spellings(type).nrrd_name); }

Samples empty_samples(SampleType type) {
  switch (type) {
    case SampleType::kU8:
      return SampleArray<std::uint8_t>();
    case SampleType::kI8:
      return SampleArray<std::int8_t>();
    case SampleType::kU16:
      return SampleArray<std::uint16_t>();
    case SampleType::kI16:
      return SampleArray<std::int16_t>();
    case SampleType::kI32:
      return SampleArray<std::int32_t>();
    case SampleType::kF32:
      return SampleArray<float>();
    case SampleType::kF64:
      break;
  }
  return SampleArray<double>();
}

std::span<const std::byte> sample_bytes(const Samples& samples) {
  return visit_samples(samples, [](const auto& s) { return std::as_bytes(std::span(s)); });
}

Samples little_endian(const Samples& samples) {
  if constexpr (kHostEndian == Endian::kLittle) return samples;
  return visit_samples(samples, []<class Sample>(const SampleArray<Sample>& s) -> Samples {
    std::vector<Sample> swapped(s.begin(), s.end());
    swap_bytes(std::span(swapped));
    return swapped;
  });
}

}  // namespace deliso
