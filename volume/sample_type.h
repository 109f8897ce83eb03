// The sample types of volumes and of their files: spellings, sizes and byte orders.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "volume/scalar_grid.h"

namespace deliso {

// In the order of the alternatives of Samples.
enum class SampleType { kU8, kI8, kU16, kI16, kI32, kF32, kF64 };

// The types in files: first those of SampleType, in their order, then those that become one of them when they are read.
// A half becomes a float, a bool a u8; the others become an i32 when all their values fit, else a double.
enum class StoredType { kU8, kI8, kU16, kI16, kI32, kF32, kF64, kU32, kU64, kI64, kF16, kBool };

enum class Endian { kLittle, kBig };

inline constexpr Endian kHostEndian = std::endian::native == std::endian::little ? Endian::kLittle : Endian::kBig;
static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

// The type named by any of the spellings of NRRD ("unsigned char", "uint8", "uint8_t", "short int", "float", ...), of
// the Open SciVis collection ("float32", ...) or of ScalarGrid::type_name ("u8", ...). Case and runs of blanks do not
// matter.
std::optional<StoredType> parse_stored_type(std::string_view name);

// The list of supported types for error messages.
std::string supported_sample_types();

// Bytes of one sample in a file.
std::size_t stored_size(StoredType type);

// The short name: "u8", "i8", "u16", "i16", "i32", "f32", "f64", "u32", "u64", "i64", "f16" or "bool".
std::string short_type_name(StoredType type);

// The type in memory, where it is the same.
inline std::optional<SampleType> kept_as(StoredType type) {
  if (type > StoredType::kF64) return std::nullopt;
  return static_cast<SampleType>(type);
}

// Bytes of one sample.
std::size_t sample_size(SampleType type);

// The spelling that files are written with: uint8, int8, uint16, int16, int32, float, double (as in NRRD).
std::string nrrd_type_name(SampleType type);

// The type of the samples.
inline SampleType sample_type(const Samples& samples) { return static_cast<SampleType>(samples.index()); }

// No samples, of the type.
Samples empty_samples(SampleType type);

// The samples as they lie in memory.
std::span<const std::byte> sample_bytes(const Samples& samples);

// Reverses the bytes of every sample.
template <class Sample>
void swap_bytes(std::span<Sample> samples) {
  if constexpr (sizeof(Sample) > 1) {
    for (Sample& sample : samples) {
      auto bytes = std::bit_cast<std::array<std::byte, sizeof(Sample)>>(sample);
      std::reverse(bytes.begin(), bytes.end());
      sample = std::bit_cast<Sample>(bytes);
    }
  }
}

// The samples with the bytes of each in little-endian order.
Samples little_endian(const Samples& samples);

}  // namespace deliso
