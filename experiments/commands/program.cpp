#include "experiments/commands/program.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/commands/commands.h"
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

// CLI11 would only say that a command is missing.
void check_first_argument(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2) return;
  const std::string_view name = argv[1];
  if (name.starts_with('-')) {
    if (name == "--version" || name == "--help" || name == "-h") return;
    throw InputError("unknown option '" + std::string(name) + "', expected a command first (deliso --help lists all)");
  }
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw InputError("unknown command '" + std::string(name) + "', the nearest is '" + nearest_name(name, names) +
                   "' (deliso --help lists all)");
}

const CLI::App* find_command(const CLI::App& app, std::string_view name) {
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

// CLI11 would first tell which required options are missing, where one is only misspelt.
void check_option_names(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = argc < 2 ? nullptr : find_command(app, argv[1]);
  if (command == nullptr) return;
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::string_view name = argument.substr(0, argument.find('='));
    if (name == "--") return;
    if (!name.starts_with("--") || std::find(names.begin(), names.end(), name) != names.end()) continue;
    const auto longer = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.starts_with(name); });
    throw InputError("unknown option '" + std::string(name) + "' of " + argv[1] + ", the nearest is '" +
                     (longer != names.end() ? *longer : nearest_name(name, names)) + "' (deliso " + argv[1] +
                     " --help lists all)");
  }
}

ExitCode run(int argc, const char* const* argv) {
  CLI::App app("Certified Delaunay meshes of isosurfaces of scalar volumes", "deliso");
  app.set_version_flag("--version", version_text);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done (and proven), 1 not proven, 2 bad usage or input, 3 stopped early, 70 internal error.");
  ExitCode exit_code = ExitCode::kDone;
  add_mesh_command(app, exit_code);
  add_verify_command(app, exit_code);
  add_topology_command(app, exit_code);
  add_info_command(app, exit_code);
  add_generate_command(app, exit_code);
  add_run_command(app, exit_code);
  add_table_command(app, exit_code);
  add_render_command(app, exit_code);
  add_schema_command(app, exit_code);
  check_first_argument(app, argc, argv);
  check_option_names(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help or --version
    app.exit(request);
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + " (deliso --help tells more)");
  }
  return exit_code;
}

}  // namespace

ExitCode run_program(int argc, const char* const* argv) {
  try {
    stop_at_signals();
    const ExitCode exit_code = run(argc, argv);
    // A result that did not reach its reader (a full disk, say) is no success.
    std::cout.flush();
    return std::cout ? exit_code : fail(ExitCode::kBadInput, "cannot write to standard output");
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
