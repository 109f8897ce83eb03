// The program `deliso`: reads the command line, runs one command, and reports failures as messages and exit codes.
#pragma once

#include "experiments/system/exit_code.h"

namespace deliso {

ExitCode run_program(int argc, const char* const* argv);

}  // namespace deliso
