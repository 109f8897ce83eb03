#include "experiments/system/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <string_view>
#include <system_error>

#include "delaunay/base/check.h"
#include "experiments/system/stop_signal.h"
#include "volume/io/base/atomic_file.h"
#include "volume/io/base/input_file.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// Opens for writing. A pipe without a reader is refused, because waiting for a reader could take forever.
int open_special(const fs::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    throw InputError(path.string() + ": " + (errno == ENXIO ? "no program reads this pipe" : std::strerror(errno)));
  }
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

void write_special(std::string_view text, const fs::path& path) {
  const int file = open_special(path);
  bool written = true;
  while (!text.empty() && written) {
    const ssize_t count = write(file, text.data(), text.size());
    written = count >= 0 || errno == EINTR;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  const int reason = errno;
  close(file);
  if (!written) throw InputError(path.string() + ": writing failed: " + std::strerror(reason));
}

}  // namespace

bool is_standard_stream(const fs::path& path) { return path == "-"; }

bool is_special(const fs::path& path) {
  if (is_standard_stream(path)) return true;
  if (path.parent_path() == "/dev" || path.parent_path() == "/dev/fd") return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::string read_text(const fs::path& path) {
  InputFile file(path);
  std::string text(file.remaining(), '\0');
  text.resize(file.read(std::as_writable_bytes(std::span(text))));
  return text;
}

void write_text(const std::string& text, const fs::path& path) {
  if (is_standard_stream(path)) {
    std::cout << text << std::flush;
    return;
  }
  if (is_special(path)) {
    write_special(text, path);
    return;
  }
  StopHold hold;
  AtomicFile file(path);
  file.write(text);
  file.commit();
  hold.finish();
}

void write_to_standard_output(const std::function<void(const std::string& path)>& write, const std::string& extension) {
  // A folder of its own, which is gone afterwards whatever happens.
  struct Folder {
    std::string path = (fs::temp_directory_path() / "deliso-XXXXXX").string();
    Folder() {
      if (mkdtemp(path.data()) == nullptr)
        throw InputError("standard output: no temporary folder " + path + ": " + std::strerror(errno));
    }
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  };
  const Folder folder;
  const std::string path = folder.path + "/volume" + extension;
  write(path);
  std::cout << read_text(path) << std::flush;
}

void check_writable(const fs::path& path, const std::string& option) {
  std::error_code error;
  if (is_standard_stream(path)) return;
  if (path.empty()) throw InputError(option + ": expected the name of a file, found an empty one");
  if (fs::is_directory(path, error)) {
    throw InputError(option + ": " + path.string() + " is a directory, expected the name of a file");
  }
  if (is_special(path)) {
    try {
      // A pipe stays open to the end of the program: closing it would signal the end of the data to its reader.
      const int file = open_special(path);
      if (!fs::is_fifo(path, error)) close(file);
    } catch (const InputError& refusal) {
      throw InputError(option + ": " + refusal.what());
    }
    return;
  }
  const fs::path folder = path.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw InputError(option + ": the folder of " + path.string() + " does not exist");
  }
  const StopHold hold;
  try {
    const AtomicFile probe(path);  // never committed, so nothing stays
  } catch (const InputError& refusal) {
    throw InputError(option + ": " + refusal.what());
  }
  hold.check();
}

void check_replaceable(const fs::path& path, const std::string& option) {
  if (is_special(path)) {
    throw InputError(option + ": " + path.string() + " is not a regular file, expected the name of one");
  }
  check_writable(path, option);
}

}  // namespace deliso
