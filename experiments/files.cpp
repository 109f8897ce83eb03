#include "experiments/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "delaunay/base/check.h"
#include "experiments/stop_signal.h"
#include "volume/io/atomic_file.h"
#include "volume/io/input_file.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// A device, a pipe or a stream that is already open (/dev/stdout): there is no file to replace.
bool is_special(const fs::path& path) {
  if (path.string().starts_with("/dev/")) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// A link stays one: the file it points to is replaced.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target;
}

}  // namespace

std::string read_text(const fs::path& path) {
  InputFile file(path);
  std::string text(file.remaining(), '\0');
  text.resize(file.read(std::as_writable_bytes(std::span(text))));
  return text;
}

void write_text(const std::string& text, const fs::path& path) {
  if (is_special(path)) {
    std::ofstream stream(path, std::ios::binary | std::ios::app);
    stream << text;
    stream.close();
    if (!stream) throw InputError(path.string() + ": writing failed");
    return;
  }
  StopHold hold;
  AtomicFile file(resolved(path));
  file.write(text);
  file.commit();
  hold.finish();
}

void check_writable(const fs::path& path, const std::string& option) {
  std::error_code error;
  if (path.empty()) throw InputError(option + ": expected the name of a file, found an empty one");
  if (fs::is_directory(path, error)) {
    throw InputError(option + ": " + path.string() + " is a directory, expected the name of a file");
  }
  if (is_special(path)) {
    if (access(path.c_str(), W_OK) == 0) return;
    throw InputError(option + ": " + path.string() + ": " + std::strerror(errno));
  }
  const fs::path folder = resolved(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw InputError(option + ": the folder of " + path.string() + " does not exist");
  }
  const StopHold hold;
  try {
    const AtomicFile probe(resolved(path));  // never committed, so nothing stays
  } catch (const InputError& refusal) {
    throw InputError(option + ": " + refusal.what());
  }
  hold.check();
}

}  // namespace deliso
