// A file of input, and the same uncompressed when its content says that it is gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>

#include "volume/io/base/byte_stream.h"
#include "volume/io/base/gzip_stream.h"

namespace deliso {

// An open regular file.
class InputFile : public ByteStream {
 public:
  // Throws InputError when there is no such file, it is not a regular file (a directory, a pipe) or cannot be read.
  explicit InputFile(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Bytes between here and the end of the file.
  [[nodiscard]] std::uint64_t remaining() const { return size_ - position_; }
  [[nodiscard]] std::uint64_t position() const { return position_; }
  // Throws InputError when reading fails.
  std::size_t read(std::span<std::byte> out) override;
  [[nodiscard]] std::uint64_t bound() const override { return remaining(); }
  std::optional<std::string> read_line() override;
  void skip(std::uint64_t count, const std::string& what) override;
  // Goes to a place in the file. Precondition: it is not beyond the end.
  void seek(std::uint64_t position);
  [[nodiscard]] std::string name() const override { return path_.string(); }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

// The bytes of a file, uncompressed when they begin as gzip does (whatever the file's name says).
class UnpackedFile {
 public:
  // `stands_alone`: no other file is found by its name, as of a stream that is kept in a file without a name.
  explicit UnpackedFile(std::filesystem::path path, bool stands_alone = false);

  // Precondition to looking for a file beside it: throws InputError where this one stands alone.
  void require_folder();
  [[nodiscard]] InputFile& file() { return file_; }
  [[nodiscard]] ByteStream& bytes() { return gzip_ ? static_cast<ByteStream&>(*gzip_) : file_; }
  [[nodiscard]] bool is_packed() const { return gzip_.has_value(); }
  // The file itself when its bytes are those that come: only then they can be mapped.
  [[nodiscard]] const InputFile* mappable() const { return gzip_ ? nullptr : &file_; }
  // Begins again at the first byte.
  void rewind();

 private:
  InputFile file_;
  bool stands_alone_;
  std::optional<GzipReader> gzip_;
};

// The extension of a file in small letters, with its dot; of `a.nii.gz` it is ".nii": that something is packed is told
// by the content.
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace deliso
