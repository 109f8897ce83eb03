#include "experiments/system/standard_input.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

// Calls take(bytes) for one piece after another.
template <class Take>
void read_standard_input(const Take& take) {
  std::array<char, std::size_t{1} << 16> buffer;
  while (true) {
    const ssize_t count = read(STDIN_FILENO, buffer.data(), buffer.size());
    if (count == 0) return;
    if (count > 0) {
      take(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
    } else if (errno != EINTR) {
      throw InputError(std::string("standard input: reading failed: ") + std::strerror(errno));
    }
  }
}

}  // namespace

std::filesystem::path standard_input_file() {
  static std::filesystem::path kept;  // what has come through a pipe does not come again
  if (!kept.empty()) return kept;
  struct stat status {};
  if (fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode)) {
    if (status.st_size == 0) throw InputError("standard input is empty");
    return "/dev/stdin";
  }
  std::FILE* const file = std::tmpfile();  // open to the end of the program: its name is that of its descriptor
  if (file == nullptr) throw InputError(std::string("standard input: no temporary file: ") + std::strerror(errno));
  bool is_written = true, is_empty = true;
  read_standard_input([&](std::string_view piece) {
    is_empty = false;
    is_written = is_written && std::fwrite(piece.data(), 1, piece.size(), file) == piece.size();
  });
  if (!is_written || std::fflush(file) != 0)
    throw InputError(std::string("standard input: the temporary file cannot be written: ") + std::strerror(errno));
  if (is_empty) throw InputError("standard input is empty");
  return kept = "/proc/self/fd/" + std::to_string(fileno(file));
}

}  // namespace deliso
