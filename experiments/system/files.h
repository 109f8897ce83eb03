// Text files of the program, and the check that a result can be written before it is computed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace deliso {

// The whole file. Throws InputError when it is missing, no regular file, or cannot be read.
std::string read_text(const std::filesystem::path& path);

// `-`: standard output, or standard input.
bool is_standard_stream(const std::filesystem::path& path);

// `-`, a device, a pipe or a stream that is already open (/dev/stdout): there is no file to replace.
bool is_special(const std::filesystem::path& path);

// Writes the whole file or nothing; `-` is standard output. An existing path that is no regular file (/dev/stdout, a
// pipe) is written directly; a pipe without a reader is refused. Throws InputError.
void write_text(const std::string& text, const std::filesystem::path& path);

// For files that are written under a name alone: calls write(path) with a temporary one of this extension, and sends
// what it has written to standard output.
void write_to_standard_output(const std::function<void(const std::string& path)>& write, const std::string& extension);

// Throws InputError unless write_text could write there now. Leaves nothing behind. Messages call the path `option`.
void check_writable(const std::filesystem::path& path, const std::string& option);

// The same for a file that is written whole and moved into place, which needs a regular file or a new one.
void check_replaceable(const std::filesystem::path& path, const std::string& option);

}  // namespace deliso
