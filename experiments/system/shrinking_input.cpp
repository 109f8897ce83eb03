#include "experiments/system/shrinking_input.h"

#include <unistd.h>

#include <array>
#include <cctype>
#include <csignal>
#include <cstddef>
#include <string>

#include "experiments/system/exit_code.h"

namespace deliso {
namespace {

// The line to write, made beforehand: a signal handler cannot. Written by the main thread before the file is mapped.
std::array<char, 4096> shrunk_line{};
std::size_t shrunk_length = 0;

// Calls only what is safe in a signal handler.
extern "C" void end_of_input(int signal, siginfo_t* info, void* /*context*/) {
  if (info->si_code != BUS_ADRERR) {  // no page beyond the end of a file
    std::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, shrunk_line.data(), shrunk_length);
  _exit(static_cast<int>(ExitCode::kBadInput));
}

}  // namespace

void end_where_input_shrinks(const std::filesystem::path& path) {
  constexpr const char* kSentence =
      ": the file became shorter, or its disk failed, while it was read; expected a file that nobody changes\n";
  const std::string end = kSentence;
  std::string line = ("deliso: " + path.string()).substr(0, shrunk_line.size() - end.size());
  for (char& c : line) c = std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  line += end;
  shrunk_length = line.copy(shrunk_line.data(), shrunk_line.size());

  struct sigaction action {};
  action.sa_sigaction = end_of_input;
  action.sa_flags = static_cast<int>(SA_SIGINFO);
  sigaction(SIGBUS, &action, nullptr);
}

}  // namespace deliso
