// Bytes from a file, plain or compressed, with errors that name the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "volume/sample_type.h"

namespace deliso {

// An open regular file.
class InputFile {
 public:
  // Throws InputError when there is no such file, it is not a regular file (a directory, a pipe) or cannot be read.
  explicit InputFile(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Bytes between here and the end of the file.
  [[nodiscard]] std::uint64_t remaining() const { return size_ - position_; }
  // Fills `out`; returns the number of bytes, fewer only at the end of the file. Throws InputError when reading fails.
  std::size_t read(std::span<std::byte> out);
  // The next line without its line end (\n or \r\n), or nothing at the end of the file. Throws InputError when a line
  // is longer than 1 MiB: the file is then no text.
  std::optional<std::string> read_line();
  // Goes `count` bytes on. Precondition: count <= remaining().
  void skip(std::uint64_t count);
  // Throws InputError: "<path>: <sentence>".
  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

enum class Compression { kNone, kGzip };

// The layout of the samples in a file.
struct SampleLayout {
  SampleType type = SampleType::kU8;
  Dims dims{};
  Endian endian = Endian::kLittle;
  Compression compression = Compression::kNone;
  std::uint64_t skipped_bytes = 0;  // to skip first, after decompression
  std::array<bool, 3> flipped{};    // axes whose samples lie in reverse order
};

// Files of this many bytes or more are mapped into memory rather than read, where their samples lie as we use them.
inline constexpr std::uint64_t kMappedFileBytes = std::uint64_t{64} << 20;

// Reads the samples that make up the rest of the file. They are mapped when the file has at least `mapped_from` bytes
// and the samples are uncompressed, aligned, in this machine's byte order and not to be reversed. Never allocates more
// than the file can hold: the size that the layout claims is first compared with the file's size (for gzip with the
// most that deflate can expand to, 1032 to 1). Throws InputError when the data are too short, too long or corrupt, or
// memory does not suffice.
Samples read_samples(InputFile& file, const SampleLayout& layout, std::uint64_t mapped_from = kMappedFileBytes);

// The same checks as checked_sample_count and the constructor of ScalarGrid, with errors that name the file.
std::size_t sample_count_of(const InputFile& file, const Dims& dims);
ScalarGrid make_grid(const InputFile& file, const Dims& dims, Samples samples, const Vec3& spacing, const Vec3& origin);

}  // namespace deliso
