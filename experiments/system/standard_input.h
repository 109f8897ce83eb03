// Standard input as a file of input.
#pragma once

#include <filesystem>

namespace deliso {

// A name under which the bytes of standard input can be read as often as wanted. What comes through a pipe is first
// written to a temporary file that has no name of its own and goes with the program; it is read once, whoever asks.
// Throws InputError, also when nothing comes.
std::filesystem::path standard_input_file();

}  // namespace deliso
