#include "volume/sample_type.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace deliso {

namespace {

struct Spellings {
  std::size_t size;
  std::string_view short_name;
  std::string_view nrrd_name;
  std::array<std::string_view, 9> others;  // lower case, single blanks; unused slots are empty
};

// In the order of StoredType.
constexpr std::array<Spellings, 12> kTypes{{
    {1, "u8", "uint8", {"uint8_t", "uchar", "unsigned char"}},
    {1, "i8", "int8", {"int8_t", "signed char"}},
    {2,
     "u16",
     "uint16",
     {"uint16_t", "ushort", "unsigned short", "unsigned short int", "short unsigned int", "short unsigned"}},
    {2, "i16", "int16", {"int16_t", "short", "short int", "signed short", "signed short int"}},
    {4, "i32", "int32", {"int32_t", "int", "signed int", "signed"}},
    {4, "f32", "float", {"float32"}},
    {8, "f64", "double", {"float64"}},
    {4, "u32", "uint32", {"uint32_t", "uint", "unsigned int", "unsigned"}},
    {8,
     "u64",
     "uint64",
     {"uint64_t", "ulonglong", "unsigned long long", "unsigned long long int", "unsigned long", "ulong"}},
    {8,
     "i64",
     "int64",
     {"int64_t", "longlong", "long long", "long long int", "signed long long", "signed long long int", "long"}},
    {2, "f16", "float16", {"half"}},
    {1, "bool", "bool", {}},
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

const Spellings& spellings(StoredType type) { return kTypes.at(static_cast<std::size_t>(type)); }

}  // namespace

std::optional<StoredType> parse_stored_type(std::string_view name) {
  const std::string wanted = normalized(name);
  if (wanted.empty()) return std::nullopt;
  for (std::size_t n = 0; n < kTypes.size(); ++n) {
    const Spellings& type = kTypes.at(n);
    const bool is_other = std::find(type.others.begin(), type.others.end(), wanted) != type.others.end();
    if (wanted == type.short_name || wanted == type.nrrd_name || is_other) return static_cast<StoredType>(n);
  }
  return std::nullopt;
}

std::string supported_sample_types() {
  return "uint8, int8, uint16, int16, uint32, int32, uint64, int64, bool, float16, float or double";
}

std::size_t stored_size(StoredType type) { return spellings(type).size; }

std::string short_type_name(StoredType type) { return std::string(spellings(type).short_name); }

std::size_t sample_size(SampleType type) { return stored_size(static_cast<StoredType>(type)); }

std::string nrrd_type_name(SampleType type) { return std::string(spellings(static_cast<StoredType>(type)).nrrd_name); }

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
