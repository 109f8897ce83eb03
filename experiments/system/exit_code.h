// The exit codes of the program.
#pragma once

namespace deliso {

enum class ExitCode : int {
  kDone = 0,       // success; if something was to be proven, it is proven
  kNotProven = 1,  // finished, but the result differs or a check failed
  kBadInput = 2,   // bad usage or bad input: a line on stderr for each mistake, no output file
  kStopped = 3,    // stopped by a budget or a signal: the output is a valid partial result
  kInternal = 70,  // a broken invariant of ours
};

}  // namespace deliso
