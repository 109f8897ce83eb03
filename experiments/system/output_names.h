// Checks that no output of a command overwrites another output, or an input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace deliso {

// A file as the command line names it.
struct NamedFile {
  std::string option;  // what messages call it
  std::filesystem::path path;
};

// Throws InputError when an output is the same file as an input or an earlier output, however their names are spelt,
// links included. Empty names and devices (/dev/stdout) are left out.
void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

// The same of the files beside a volume that hold its samples, which are known once its header is read.
void check_apart_from_data(const std::vector<std::filesystem::path>& data_files, const std::vector<NamedFile>& outputs);

// Throws InputError when more than one of the outputs is `-`, standard output.
void check_one_standard_output(const std::vector<NamedFile>& outputs);

// The same of inputs and standard input.
void check_one_standard_input(const std::vector<NamedFile>& inputs);

}  // namespace deliso
