// What the commands' options have in common: numbers as typed, the volume and the isovalue.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "volume/scalar_grid.h"

namespace deliso {

// A finite decimal number. Throws InputError naming the option.
double parse_number(const std::string& text, const std::string& option);

// A whole number from `low` to `high`. Throws InputError naming the option and the range.
std::uint64_t parse_count(const std::string& text, const std::string& option, std::uint64_t low, std::uint64_t high);

// For CLI::Option::check of an option that names a file or folder: what is wrong with the name, or nothing. An empty
// name would pass for an option that is not there.
std::string refuse_empty_name(const std::string& name);

// The options that name a volume, as typed. Those beyond the path describe a .raw file, which cannot describe itself.
struct VolumeOptions {
  std::string path;
  std::string dims;
  std::string type;
  std::string endian;
  std::string spacing;
};

void add_volume_options(CLI::App& command, VolumeOptions& options);

// Throws InputError when the file or the options are wrong.
ScalarGrid load_volume(const VolumeOptions& options);

// Throws InputError naming the range of the data unless the isosurface has a point (low < isovalue <= high), or when
// samples are too large or too close to each other to compute with.
void check_isovalue(const ScalarGrid& grid, double isovalue);

// Says on stderr, when another isovalue was used, which one and why.
void remark_isovalue(const ScalarGrid& grid, double isovalue, double used);

}  // namespace deliso
