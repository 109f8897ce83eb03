// Several files whose bytes follow each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "volume/io/base/input_file.h"

namespace deliso {

// Files are opened one at a time. Errors name the file of the header.
class FileRow : public ByteStream {
 public:
  // Throws InputError when a file is missing.
  FileRow(std::vector<std::filesystem::path> paths, std::uint64_t skipped_in_each, const ByteStream& owner);

  std::size_t read(std::span<std::byte> out) override;
  [[nodiscard]] std::uint64_t bound() const override { return bound_; }
  [[nodiscard]] std::string name() const override { return owner_.name(); }

 private:
  std::vector<std::filesystem::path> paths_;
  std::uint64_t skipped_;
  const ByteStream& owner_;
  std::uint64_t bound_ = 0;
  std::size_t next_ = 0;
  std::optional<InputFile> file_;
};

}  // namespace deliso
