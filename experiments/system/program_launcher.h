// Starts programs from a small process, so that their peak memory is their own.
//
// What Linux tells of a program's memory begins with that of the process that started it. So a launcher is made before
// a process fills its memory, and starts programs on its behalf.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <string>
#include <vector>

#include "experiments/system/child_program.h"

namespace deliso {

class ProgramLauncher {
 public:
  // Starts the process that starts programs. Precondition: this process has no other threads.
  ProgramLauncher();
  ~ProgramLauncher();
  ProgramLauncher(const ProgramLauncher&) = delete;
  ProgramLauncher& operator=(const ProgramLauncher&) = delete;

  // run_child, there. When `stop` is set the program is ended. Throws InputError.
  ChildResult run(const std::string& program, const std::vector<std::string>& arguments, double seconds,
                  const std::atomic<bool>* stop);

 private:
  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace deliso
