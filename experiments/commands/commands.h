// The commands of the program, one file each.
#pragma once

#include <CLI/CLI.hpp>

#include "experiments/system/exit_code.h"

namespace deliso {

// Each adds one command with its options to `app`. When the command line names it, CLI11 runs it while parsing; it then
// sets `exit_code`, or throws.
void add_mesh_command(CLI::App& app, ExitCode& exit_code);
void add_verify_command(CLI::App& app, ExitCode& exit_code);
void add_topology_command(CLI::App& app, ExitCode& exit_code);
void add_info_command(CLI::App& app, ExitCode& exit_code);
void add_generate_command(CLI::App& app, ExitCode& exit_code);
void add_run_command(CLI::App& app, ExitCode& exit_code);
void add_table_command(CLI::App& app, ExitCode& exit_code);
void add_render_command(CLI::App& app, ExitCode& exit_code);
void add_schema_command(CLI::App& app, ExitCode& exit_code);

}  // namespace deliso
