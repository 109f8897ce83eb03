// The commands of the program, one file each.
#pragma once

#include "experiments/commands/command.h"
#include "experiments/system/exit_code.h"

namespace deliso {

// Each adds one command with its options. When the command line names it, it runs while parsing; it then sets
// `exit_code`, or throws.
void add_mesh_command(CommandLine& line, ExitCode& exit_code);
void add_verify_command(CommandLine& line, ExitCode& exit_code);
void add_topology_command(CommandLine& line, ExitCode& exit_code);
void add_info_command(CommandLine& line, ExitCode& exit_code);
void add_generate_command(CommandLine& line, ExitCode& exit_code);
void add_run_command(CommandLine& line, ExitCode& exit_code);
void add_table_command(CommandLine& line, ExitCode& exit_code);
void add_render_command(CommandLine& line, ExitCode& exit_code);
void add_explain_command(CommandLine& line, ExitCode& exit_code);
void add_schema_command(CommandLine& line, ExitCode& exit_code);

}  // namespace deliso
