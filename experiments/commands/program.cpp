#include "experiments/commands/program.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cstddef>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/config/mistakes.h"
#include "experiments/system/program_info.h"
#include "experiments/system/stop_signal.h"

namespace deliso {
namespace {

// A message takes one line, whatever a file name or a value holds.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

ExitCode fail(ExitCode code, const std::string& message) {
  std::cerr << "deliso: " << one_line(message) << '\n';
  return code;
}

ExitCode fail_internally(const std::string& what) {
  const ProgramInfo info = program_info();
  return fail(ExitCode::kInternal, "internal error: " + what +
                                       "; please report this line, the command and its input (version " + info.version +
                                       ", commit " + info.commit + ")");
}

std::string version_text() {
  const ProgramInfo info = program_info();
  return "deliso " + info.version + "\ncommit   " + info.commit + "\ncompiler " + info.compiler + "\nflags    " +
         info.flags;
}

// The stack grows as calls need it. Where memory is limited (ulimit -v) it may be unable to, in the midst of a call,
// which ends a program without a word. So it grows now, after a look whether it can.
constexpr std::size_t kStackBytes = std::size_t{1} << 20;

[[gnu::noinline]] void check_room_for_stack() {
  const std::vector<char> room(kStackBytes);
  static_cast<void>(*static_cast<const volatile char*>(room.data()));
}

[[gnu::noinline]] void grow_stack() {
  constexpr std::size_t kPage = 4096;
  std::array<char, kStackBytes> stack;  // NOLINT: only its pages are wanted
  volatile char* const pages = stack.data();
  for (std::size_t i = kStackBytes; i >= kPage; i -= kPage) pages[i - 1] = 0;
}

// When memory ends, what was made is destroyed again, and the destructor of a JSON document allocates. So some memory
// is kept back until then, in pieces small enough to be given out again by the heap.
class Reserve {
 public:
  static void keep() {
    for (std::atomic<char*>& piece : pieces) piece = new char[kPiece];
    std::set_new_handler(give_back);
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 14;

  [[noreturn]] static void give_back() {
    for (std::atomic<char*>& piece : pieces) delete[] piece.exchange(nullptr);
    throw std::bad_alloc();
  }

  static inline std::array<std::atomic<char*>, 8> pieces = {};
};

ExitCode run(int argc, const char* const* argv) {
  CommandLine line(
      "Certified Delaunay meshes of isosurfaces of scalar volumes",
      "Exit codes: 0 done (and proven), 1 not proven, 2 bad usage or input, 3 stopped early, 70 internal error.",
      version_text);
  ExitCode exit_code = ExitCode::kDone;
  add_mesh_command(line, exit_code);
  add_verify_command(line, exit_code);
  add_topology_command(line, exit_code);
  add_info_command(line, exit_code);
  add_generate_command(line, exit_code);
  add_run_command(line, exit_code);
  add_table_command(line, exit_code);
  add_render_command(line, exit_code);
  add_explain_command(line, exit_code);
  add_schema_command(line, exit_code);
  line.parse(argc, argv);
  return exit_code;
}

}  // namespace

ExitCode run_program(int argc, const char* const* argv) {
  try {
    check_room_for_stack();
    grow_stack();
    Reserve::keep();
    stop_at_signals();
    const ExitCode exit_code = run(argc, argv);
    // A result that did not reach its reader (a full disk, say) is no success.
    std::cout.flush();
    return std::cout ? exit_code : fail(ExitCode::kBadInput, "cannot write to standard output");
  } catch (const SeveralMistakes& mistakes) {
    for (const std::string& sentence : mistakes.sentences()) fail(ExitCode::kBadInput, sentence);
    return ExitCode::kBadInput;
  } catch (const InputError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const Stopped& stopped) {
    return fail(ExitCode::kStopped, stopped.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kBadInput, "not enough memory for this volume and these parameters");
  } catch (const std::exception& error) {
    return fail_internally(error.what());
  }
}

}  // namespace deliso
