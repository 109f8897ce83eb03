// Input files that someone shortens, or whose disk fails, while they are mapped into memory
// (volume/io/base/mapped_file.h).
#pragma once

#include <filesystem>

namespace deliso {

// Call before a file is read that may be mapped. From now on reading what is gone of it (SIGBUS) ends the program with
// one line on stderr that names the file, the last one given, and ExitCode::kBadInput.
void end_where_input_shrinks(const std::filesystem::path& path);

}  // namespace deliso
