// Samples from bytes: any stored type, byte order, order of axes and choice of a channel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "volume/io/base/input_file.h"
#include "volume/sample_type.h"
#include "volume/scalar_grid.h"

namespace deliso {

enum class Compression { kNone, kGzip };

// The layout of the samples in a stream of bytes. A sample may be one of several values at its place (components, a
// colour or a vector), and the volume one of several that follow each other (time steps).
struct SampleLayout {
  StoredType type = StoredType::kU8;
  Dims dims{};
  Endian endian = Endian::kLittle;
  Compression compression = Compression::kNone;
  std::uint64_t skipped_bytes = 0;  // to skip first, after decompression
  std::array<bool, 3> flipped{};    // axes whose samples lie in reverse order
  std::uint64_t components = 1;
  std::uint64_t volumes = 1;
  std::uint64_t channel = 0;                       // the one to read: component + components * volume
  bool is_z_fastest = false;                       // the samples lie z fastest, x slowest
  bool may_go_on = false;                          // more bytes may follow
  std::optional<std::pair<double, double>> scale;  // value = first * stored + second, as doubles
};

// Files of this many bytes or more are mapped into memory rather than read, where their samples lie as we use them.
inline constexpr std::uint64_t kMappedFileBytes = std::uint64_t{64} << 20;

// Reads the samples that make up the rest of the stream. They are mapped when the stream is a file of at least
// `mapped_from` bytes and its samples are uncompressed, aligned, of a type of ours, in this machine's byte order and
// not to be moved. Never allocates more than the stream can hold: the size that the layout claims is first compared
// with its bound. Throws InputError when the data are too short, too long or corrupt, a value is none that a double
// holds (naming the first voxel), or memory does not suffice.
Samples read_samples(ByteStream& stream, const SampleLayout& layout, const InputFile* file = nullptr,
                     std::uint64_t mapped_from = kMappedFileBytes);
inline Samples read_samples(InputFile& file, const SampleLayout& layout, std::uint64_t mapped_from = kMappedFileBytes) {
  return read_samples(file, layout, &file, mapped_from);
}

// The same checks as checked_sample_count, with errors that name the file.
std::size_t sample_count_of(const ByteStream& file, const Dims& dims);

}  // namespace deliso
