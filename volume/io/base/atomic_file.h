// An output file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace deliso {

// What a path names behind its links, which need not exist; any other path as it is.
std::filesystem::path behind_links(std::filesystem::path path);

// Writes go to a temporary file beside `path`; commit() renames it to `path`. Without a commit nothing stays behind and
// an older file of that name is left as it was. A link stays one: the file that it points to is replaced, or made. A
// file that is replaced keeps its permissions.
class AtomicFile {
 public:
  // Throws InputError when no file can be made there, or `path` exists and is not a regular file or write-protected.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Throw InputError when the file system refuses.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);
  void commit();

 private:
  [[noreturn]] void fail(const std::string& doing) const;
  void discard() noexcept;

  std::filesystem::path path_;
  std::filesystem::path target_;  // what path_ points to when it is a link
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

}  // namespace deliso
