// A file read through the system's page cache, without a copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace deliso {

// A read-only view of a whole file. If someone shortens the file while it is mapped, this process gets a SIGBUS, which
// the program takes for a bad input (experiments/system/shrinking_input.h); elsewhere map only files that do not
// change.
class MappedFile {
 public:
  // Nothing when the system cannot map the file, or its size is not `size` bytes (any more).
  static std::shared_ptr<const MappedFile> open(const std::filesystem::path& path, std::uint64_t size);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  // Begins at a multiple of the page size.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace deliso
