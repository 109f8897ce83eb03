#include "volume/io/base/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

std::filesystem::path behind_links(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // as for the system
  std::error_code error;
  for (int n = 0; n < kMostLinks && std::filesystem::is_symlink(path, error); ++n) {
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), target_(behind_links(path_)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  const bool is_there = std::filesystem::exists(status);
  if (std::filesystem::is_symlink(target_, ignored))
    throw InputError(path_.string() + ": cannot write here, this link leads to no file");
  if (is_there && !std::filesystem::is_regular_file(status))
    throw InputError(path_.string() + ": cannot write here, this is not a regular file");
  // Renaming would replace it all the same.
  errno = 0;
  if (is_there && ::access(target_.c_str(), W_OK) != 0) fail("the file that is there may not be written");
  // A name of our own: "x" refuses a file that exists, so another writer's file is never touched.
  constexpr int kTries = 100;
  std::string suffix = std::to_string(::getpid());
  suffix.insert(0, ".part-").append("-");
  for (int n = 0; n < kTries && file_ == nullptr; ++n) {
    temporary_ = target_;
    temporary_ += suffix + std::to_string(n);
    errno = 0;
    file_ = std::fopen(temporary_.c_str(), "wbx");
    if (file_ == nullptr && errno != EEXIST) break;
  }
  if (file_ == nullptr) fail("the file cannot be made");
  // The new file lets in whom the old one did. Some file systems have no modes.
  constexpr auto kModes = std::filesystem::perms::all;
  if (is_there) static_cast<void>(::fchmod(::fileno(file_), static_cast<::mode_t>(status.permissions() & kModes)));
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::span<const std::byte> bytes) {
  errno = 0;
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("writing failed");
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void AtomicFile::commit() {
  DELISO_CHECK(file_ != nullptr, "a file is committed once");
  errno = 0;
  // The bytes must be on the disk before the name points to them.
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail("writing failed");
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  std::error_code error;
  if (closed) std::filesystem::rename(temporary_, target_, error);
  if (!closed || error) {
    std::filesystem::remove(temporary_, error);
    fail("the file cannot be put in place");
  }
}

void AtomicFile::fail(const std::string& doing) const {
  std::string message = path_.string() + ": " + doing;
  if (errno != 0) message.append(": ").append(std::strerror(errno));
  throw InputError(message);
}

void AtomicFile::discard() noexcept {
  if (file_ == nullptr) return;
  std::fclose(std::exchange(file_, nullptr));
  ::unlink(temporary_.c_str());
}

}  // namespace deliso
